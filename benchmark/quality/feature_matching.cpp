// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/match_acceptance.hpp"
#include "feature_methods.hpp"

namespace ardrone_vslam::quality {

std::vector<IndexPair> matchFeatures(const FeatureSet& a, const FeatureSet& b) {
  std::vector<IndexPair> matches;
  if (a.pixel_px.empty() || b.pixel_px.empty()) return matches;
  cv::Mat distances;
  cv::batchDistance(a.descriptors, b.descriptors, distances, CV_32S, cv::noArray(),
                    cv::NORM_HAMMING);
  std::vector<BestTwo> of_a(a.pixel_px.size()), of_b(b.pixel_px.size());
  for (int i = 0; i < distances.rows; ++i) {
    const int* row = distances.ptr<int>(i);
    for (int j = 0; j < distances.cols; ++j) {
      of_a[static_cast<std::size_t>(i)].offer(j, row[j]);
      of_b[static_cast<std::size_t>(j)].offer(i, row[j]);
    }
  }
  MatcherConfig config;
  config.max_hamming_bits = kNoDistance_bits - 1;
  for (std::size_t i = 0; i < of_a.size(); ++i) {
    const int nearest = of_a[i].index;
    const bool is_mutual = of_b[static_cast<std::size_t>(nearest)].index == static_cast<int>(i);
    if (is_mutual && accept(of_a[i], config)) matches.emplace_back(static_cast<int>(i), nearest);
  }
  return matches;
}

}  // namespace ardrone_vslam::quality
