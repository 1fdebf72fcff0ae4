// SPDX-License-Identifier: BSD-3-Clause
#include <memory>
#include <opencv2/features2d.hpp>

#include "ardrone_vslam/tracker.hpp"
#include "frames.hpp"
#include "row.hpp"
#include "rows.hpp"

namespace ardrone_vslam::bench {
namespace {

auto ours(int features, const Frames& (*frames)(), bool align_tracks = true) {
  return [=] {
    TrackerConfig config;
    config.corners.features_per_frame = features;
    config.align_tracks = align_tracks;
    auto tracker = std::make_shared<Tracker>(config, frames().camera);
    auto found = std::make_shared<ImageFeatures>();
    return [=](std::size_t i) {
      tracker->process(frames().view(i), static_cast<std::int64_t>(i + 1), *found);
      return found->size();
    };
  };
}

/// What a user would build of OpenCV's parts: as many features, matched to the frame before.
auto openCv(int features, const Frames& (*frames)()) {
  struct State {
    cv::Ptr<cv::ORB> orb;
    cv::BFMatcher matcher{cv::NORM_HAMMING};
    std::vector<cv::KeyPoint> keypoints;
    cv::Mat descriptors, previous;
    std::vector<std::vector<cv::DMatch>> matches;
  };
  return [=] {
    auto s = std::make_shared<State>();
    s->orb = cv::ORB::create(features);
    return [=](std::size_t i) {
      s->orb->detectAndCompute(frames().at(i), {}, s->keypoints, s->descriptors);
      s->matches.clear();  // knnMatch appends
      if (!s->previous.empty()) s->matcher.knnMatch(s->descriptors, s->previous, s->matches, 2);
      cv::swap(s->descriptors, s->previous);
      return s->keypoints.size();
    };
  };
}

}  // namespace

void addTrackerRows() {
  side("tracker_kitti", "ours", ours(600, streetFrames));
  side("tracker_kitti", "cv::ORB + cv::BFMatcher", openCv(600, streetFrames));
  constexpr bool kAlignTracks = false;
  side("tracker_whole_pixels_kitti", "ours", ours(600, streetFrames, kAlignTracks));
  side("tracker_whole_pixels_kitti", "cv::ORB + cv::BFMatcher", openCv(600, streetFrames));
  side("tracker_320x240", "ours", ours(200, smallFrames));
  side("tracker_320x240", "cv::ORB + cv::BFMatcher", openCv(200, smallFrames));
}

}  // namespace ardrone_vslam::bench
