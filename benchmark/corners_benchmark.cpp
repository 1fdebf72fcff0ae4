// SPDX-License-Identifier: BSD-3-Clause
#include <memory>
#include <opencv2/features2d.hpp>

#include "corners/corner_detector.hpp"
#include "frames.hpp"
#include "row.hpp"
#include "rows.hpp"

namespace ardrone_vslam::bench {
namespace {

constexpr int kThreshold = 35;
constexpr int kAllCorners = 20000;
constexpr int kBriskThreshold = 60;  // as many keypoints as our budget on KITTI

/// The same work as cv::FAST: one threshold, every corner, 3x3 suppression.
CornerDetectorConfig likeOpenCv(int arc_length_px) {
  CornerDetectorConfig config;
  config.arc_length_px = arc_length_px;
  config.threshold = kThreshold;
  config.suppression = Suppression::kStrict3x3;
  config.adapt_threshold = false;
  config.features_per_frame = kAllCorners;
  return config;
}

auto ours(const CornerDetectorConfig& config, const Frames& (*frames)(),
          InstructionSet set = instructionSetInUse().set) {
  return [=] {
    auto detector = std::make_shared<CornerDetector>(config, set);
    auto corners = std::make_shared<std::vector<Corner>>();
    return [=](std::size_t i) {
      detector->detect(frames().view(i), *corners);
      return corners->size();
    };
  };
}

auto openCv(const cv::Ptr<cv::Feature2D>& detector, const Frames& (*frames)()) {
  return [=] {
    auto keypoints = std::make_shared<std::vector<cv::KeyPoint>>();
    return [=](std::size_t i) {
      detector->detect(frames().at(i), *keypoints);
      return keypoints->size();
    };
  };
}

void addRowsOn(const std::string& suffix, const Frames& (*frames)()) {
  const auto fast = cv::FastFeatureDetector::create(kThreshold, true);
  for (const int arc_length_px : {9, 12}) {
    const std::string row = "fast" + std::to_string(arc_length_px) + suffix;
    side(row, "ours", ours(likeOpenCv(arc_length_px), frames));
    side(row, "cv::FAST 9_16", openCv(fast, frames));
  }
  side("fast9_agast" + suffix, "ours", ours(likeOpenCv(9), frames));
  side("fast9_agast" + suffix, "cv::AGAST 9_16",
       openCv(cv::AgastFeatureDetector::create(kThreshold, true), frames));
  // As the tracker uses it: budget spread over cells, thresholds that adapt.
  side("detector" + suffix, "ours", ours({}, frames));
  side("detector" + suffix, "our scalar form", ours({}, frames, InstructionSet::kScalar));
  // Beside detectors that work on a pyramid: as many keypoints, not the same ones.
  const int budget = CornerDetectorConfig{}.features_per_frame;
  side("detector_orb" + suffix, "ours", ours({}, frames));
  side("detector_orb" + suffix, "cv::ORB", openCv(cv::ORB::create(budget), frames));
  side("detector_brisk" + suffix, "ours", ours({}, frames));
  side("detector_brisk" + suffix, "cv::BRISK", openCv(cv::BRISK::create(kBriskThreshold), frames));
}

}  // namespace

void addCornerRows() {
  addRowsOn("_kitti", streetFrames);
  addRowsOn("_320x240", smallFrames);
  for (const int passes : {1, 2, 4, 8, 16}) {
    CornerDetectorConfig config;
    config.threshold = kThreshold;
    config.adapt_threshold = false;
    config.features_per_frame = kAllCorners;
    config.sampling_passes = passes;
    const std::string row = "passes" + std::to_string(passes) + "_kitti";
    side(row, "ours", ours(config, streetFrames));
    side(row, "our scalar form", ours(config, streetFrames, InstructionSet::kScalar));
  }
}

}  // namespace ardrone_vslam::bench
