// SPDX-License-Identifier: BSD-3-Clause
#include <memory>
#include <opencv2/video/tracking.hpp>
#include <optional>
#include <unordered_map>
#include <vector>

#include "alignment/patch.hpp"
#include "ardrone_vslam/tracker.hpp"
#include "frames.hpp"
#include "kernels/kernels.hpp"
#include "row.hpp"
#include "rows.hpp"

namespace ardrone_vslam::bench {
namespace {

constexpr int kFeatures = 600;
constexpr int kCorners = 2500;  // enough that so many are found again

/// What is to be aligned in an image: points of the image before that have structure, and the
/// corners that they were matched with.
struct ImagePair {
  std::size_t image = 0;
  std::vector<kernels::AlignPatch> patches;
  std::vector<cv::Point2f> points_px;
  std::vector<cv::Point2f> starts_px;
};

/// Evenly spread: features come cell by cell.
template <class Value>
void thinOut(std::vector<Value>& values) {
  if (values.size() <= kFeatures) return;
  for (std::size_t i = 0; i < kFeatures; ++i) values[i] = values[i * values.size() / kFeatures];
  values.resize(kFeatures);
}

std::optional<kernels::AlignPatch> patchAt(const ImageView& image, const cv::Point2f& corner_px) {
  return patchOf(
      surroundingsOf(image, static_cast<int>(corner_px.x), static_cast<int>(corner_px.y)));
}

ImagePair pairOf(std::size_t image, const ImageFeatures& before, const ImageFeatures& now) {
  std::unordered_map<std::uint32_t, std::size_t> place_of;
  for (std::size_t i = 0; i < before.size(); ++i) place_of[before.track_id[i]] = i;
  ImagePair pair;
  pair.image = image;
  for (std::size_t i = 0; i < now.size(); ++i) {
    const auto place = place_of.find(now.track_id[i]);
    if (place == place_of.end()) continue;
    const Eigen::Vector2f from_px = before.pixel_px[place->second];
    const auto patch = patchAt(streetFrames().view(image - 1), {from_px.x(), from_px.y()});
    if (!patch) continue;
    pair.patches.push_back(*patch);
    pair.points_px.emplace_back(from_px.x(), from_px.y());
    pair.starts_px.emplace_back(now.pixel_px[i].x(), now.pixel_px[i].y());
  }
  thinOut(pair.patches);
  thinOut(pair.points_px);
  thinOut(pair.starts_px);
  return pair;
}

std::vector<ImagePair> matchedPairs() {
  TrackerConfig config;
  config.align_tracks = false;
  config.corners.features_per_frame = kCorners;
  Tracker tracker(config, streetFrames().camera);
  ImageFeatures before;
  ImageFeatures now;
  std::vector<ImagePair> pairs;
  for (std::size_t i = 0; i < streetFrames().images.size(); ++i) {
    tracker.process(streetFrames().view(i), static_cast<std::int64_t>(i + 1), now);
    if (i > 0) pairs.push_back(pairOf(i, before, now));
    std::swap(before, now);
  }
  return pairs;
}

const std::vector<ImagePair>& imagePairs() {
  static const std::vector<ImagePair> pairs = matchedPairs();
  return pairs;
}

const ImagePair& pairAt(std::size_t i) {
  return imagePairs()[i % imagePairs().size()];
}

auto ours(bool is_prepared) {
  return [=] {
    imagePairs();
    const auto align = kernels::kernelsInUse().align;
    return [=](std::size_t i) {
      const ImagePair& pair = pairAt(i);
      const ImageView before = streetFrames().view(pair.image - 1);
      const ImageView now = streetFrames().view(pair.image);
      for (std::size_t k = 0; k < pair.patches.size(); ++k) {
        const cv::Point2f start_px = pair.starts_px[k];
        const cv::Point2f from_px = pair.points_px[k];
        const auto at = [&](const kernels::AlignPatch& patch) {
          return align(patch, now.data, now.stride_bytes, start_px.x, start_px.y);
        };
        benchmark::DoNotOptimize(is_prepared ? at(pair.patches[k]) : at(*patchAt(before, from_px)));
      }
      return pair.patches.size();
    };
  };
}

/// One image with its gradients, as cv::calcOpticalFlowPyrLK takes them.
using Gradients = std::vector<cv::Mat>;

const cv::Size kWindow_px(kernels::kPatchSide, kernels::kPatchSide);

std::vector<Gradients> gradientsOfAll() {
  std::vector<Gradients> result;
  for (const cv::Mat& image : streetFrames().images) {
    constexpr int kCoarsest = 0;
    cv::buildOpticalFlowPyramid(image, result.emplace_back(), kWindow_px, kCoarsest);
  }
  return result;
}

struct Flow {
  std::vector<cv::Point2f> found_px;
  std::vector<unsigned char> is_found;
  std::vector<float> error;

  std::size_t operator()(const ImagePair& pair, cv::InputArray before, cv::InputArray now) {
    const cv::TermCriteria end(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 8, 0.03);
    found_px = pair.starts_px;
    cv::calcOpticalFlowPyrLK(before, now, pair.points_px, found_px, is_found, error, kWindow_px, 0,
                             end, cv::OPTFLOW_USE_INITIAL_FLOW);
    return found_px.size();
  }
};

auto openCv(bool is_prepared) {
  return [=] {
    imagePairs();
    auto gradients = std::make_shared<std::vector<Gradients>>();
    if (is_prepared) *gradients = gradientsOfAll();
    auto flow = std::make_shared<Flow>();
    return [=](std::size_t i) {
      const ImagePair& pair = pairAt(i);
      if (is_prepared) return (*flow)(pair, (*gradients)[pair.image - 1], (*gradients)[pair.image]);
      return (*flow)(pair, streetFrames().at(pair.image - 1), streetFrames().at(pair.image));
    };
  };
}

}  // namespace

void addAlignmentRows() {
  const char* peer = "cv::calcOpticalFlowPyrLK";
  constexpr bool kIsPrepared = true;
  side("align_kitti", "ours", ours(kIsPrepared));
  side("align_kitti", peer, openCv(kIsPrepared));
  side("align_with_patches_kitti", "ours", ours(!kIsPrepared));
  side("align_with_patches_kitti", peer, openCv(!kIsPrepared));
}

}  // namespace ardrone_vslam::bench
