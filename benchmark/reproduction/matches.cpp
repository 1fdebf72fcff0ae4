// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <opencv2/flann.hpp>

#include "feature_methods.hpp"
#include "measurements.hpp"
#include "picture_changes.hpp"
#include "pictures.hpp"

namespace ardrone_vslam::reproduction {
namespace {

constexpr int kBudget = 500;
constexpr int kLimit_bits = 90;  // of 512, as the mapper's max_hamming_bits

using quality::FeatureSet;
using quality::IndexPair;

cv::Mat matrixOf(const FeatureSet& features) {
  return cv::Mat(static_cast<int>(features.descriptors.size()), sizeof(Descriptor), CV_8UC1,
                 const_cast<Descriptor*>(features.descriptors.data()))
      .clone();
}

/// Nearest descriptors by Muja and Lowe's forest, which the thesis used; nothing but the distance
/// decides.
std::vector<IndexPair> nearestByForest(const FeatureSet& a, const FeatureSet& b) {
  cv::setRNGSeed(1);
  cvflann::seed_random(1);
  const cv::Mat train = matrixOf(b), query = matrixOf(a);
  cv::flann::Index forest(train, cv::flann::HierarchicalClusteringIndexParams(),
                          cvflann::FLANN_DIST_HAMMING);
  cv::Mat indices, distances;
  forest.knnSearch(query, indices, distances, 1);
  std::vector<IndexPair> matches;
  for (int i = 0; i < query.rows; ++i)
    if (distances.at<int>(i) <= kLimit_bits) matches.emplace_back(i, indices.at<int>(i));
  return matches;
}

nlohmann::json countsOf(const PicturePair& wall, const FeatureSet& a, const FeatureSet& b,
                        const std::vector<IndexPair>& matches, const std::string& name) {
  const quality::PairTruth truth(a.pixel_px, b.pixel_px, wall.geometry);
  nlohmann::json lines = nlohmann::json::array();
  int correct = 0;
  for (const auto& [i, j] : matches) {
    const bool is_same = truth.isSamePoint(i, j);
    correct += is_same ? 1 : 0;
    const auto& p = a.pixel_px[static_cast<std::size_t>(i)];
    const auto& q = b.pixel_px[static_cast<std::size_t>(j)];
    lines.push_back({p.x(), p.y(), q.x(), q.y(), is_same ? 1 : 0});
  }
  return {{"name", name}, {"matches", matches.size()}, {"correct", correct}, {"lines", lines}};
}

}  // namespace

nlohmann::json measureMatches(bool /*quick*/) {
  const PicturePair& wall = wallPictures();
  quality::FastFreakSettings settings;
  settings.budget = kBudget;
  const auto method = quality::makeFastFreak(settings, "FAST-12 + FREAK");
  const FeatureSet a = method->extract(quality::unchanged(wall.first).view);
  const FeatureSet b = method->extract(quality::unchanged(wall.second).view);
  auto accepted = quality::matchFeatures(a, b);
  const auto isFar = [&](const IndexPair& pair) {
    int bits = 0;
    const auto& x = a.descriptors[static_cast<std::size_t>(pair.first)].words;
    const auto& y = b.descriptors[static_cast<std::size_t>(pair.second)].words;
    for (std::size_t w = 0; w < x.size(); ++w) bits += __builtin_popcountll(x[w] ^ y[w]);
    return bits > kLimit_bits;
  };
  accepted.erase(std::remove_if(accepted.begin(), accepted.end(), isFar), accepted.end());
  return {{"what", wall.what},
          {"features", {a.pixel_px.size(), b.pixel_px.size()}},
          {"limit_bits", kLimit_bits},
          {"width_px", wall.first.cols},
          {"height_px", wall.first.rows},
          {"methods",
           {countsOf(wall, a, b, nearestByForest(a, b), "nearest by Muja and Lowe's forest"),
            countsOf(wall, a, b, accepted, "this package: ratio and cross check")}}};
}

}  // namespace ardrone_vslam::reproduction
