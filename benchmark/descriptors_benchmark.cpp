// SPDX-License-Identifier: BSD-3-Clause
#include <memory>
#include <opencv2/features2d.hpp>

#include "ardrone_vslam/tracker.hpp"
#include "frames.hpp"
#include "freak/freak.hpp"
#include "row.hpp"
#include "rows.hpp"

namespace ardrone_vslam::bench {
namespace {

constexpr int kKeypoints = 600;

/// The tracker's features in each frame, for ours and the peers alike.
const std::vector<std::vector<FreakKeypoint>>& keypoints() {
  static const auto all = [] {
    TrackerConfig config;
    config.corners.features_per_frame = kKeypoints;
    Tracker tracker(config, streetFrames().camera);
    std::vector<std::vector<FreakKeypoint>> of_frames;
    ImageFeatures features;
    for (std::size_t i = 0; i < streetFrames().images.size(); ++i) {
      tracker.process(streetFrames().view(i), static_cast<std::int64_t>(i + 1), features);
      of_frames.emplace_back();
      for (const Eigen::Vector2f& pixel_px : features.pixel_px)
        of_frames.back().push_back(
            {static_cast<int>(pixel_px.x()), static_cast<int>(pixel_px.y())});
    }
    return of_frames;
  }();
  return all;
}

std::vector<std::vector<cv::KeyPoint>> openCvKeypoints() {
  std::vector<std::vector<cv::KeyPoint>> of_frames;
  for (const auto& frame : keypoints()) {
    of_frames.emplace_back();
    for (const FreakKeypoint& k : frame)
      of_frames.back().emplace_back(static_cast<float>(k.x_px), static_cast<float>(k.y_px), 7.F);
  }
  return of_frames;
}

auto ours(bool oriented, InstructionSet set = instructionSetInUse().set) {
  return [=] {
    FreakConfig config;
    config.oriented = oriented;
    auto describer = std::make_shared<FreakDescriber>(config, set);
    auto kept = std::make_shared<std::vector<int>>();
    auto descriptors = std::make_shared<std::vector<Descriptor>>();
    return [=](std::size_t i) {
      describer->describe(streetFrames().view(i), keypoints()[i % keypoints().size()], *kept,
                          *descriptors);
      return kept->size();
    };
  };
}

auto openCv(const cv::Ptr<cv::Feature2D>& describer) {
  return [=] {
    auto all = std::make_shared<std::vector<std::vector<cv::KeyPoint>>>(openCvKeypoints());
    auto kept = std::make_shared<std::vector<cv::KeyPoint>>();
    auto descriptors = std::make_shared<cv::Mat>();
    return [=](std::size_t i) {
      *kept = (*all)[i % all->size()];  // compute() takes out those near the border
      describer->compute(streetFrames().at(i), *kept, *descriptors);
      return kept->size();
    };
  };
}

}  // namespace

void addDescriptorRows() {
  side("freak_kitti", "ours", ours(true));
  side("freak_kitti", "our scalar form", ours(true, InstructionSet::kScalar));
  side("freak_brisk_kitti", "ours", ours(true));
  side("freak_brisk_kitti", "cv::BRISK", openCv(cv::BRISK::create()));
  side("freak_orb_kitti", "ours", ours(true));
  side("freak_orb_kitti", "cv::ORB", openCv(cv::ORB::create()));
  side("freak_upright_kitti", "ours", ours(false));
  side("freak_upright_kitti", "ours, 45 pairs", ours(true));
}

}  // namespace ardrone_vslam::bench
