// SPDX-License-Identifier: BSD-3-Clause
#include "loop/pose_pipeline.hpp"

#include <cstdio>
#include <utility>

#include "protocol/clocks.hpp"

namespace ardrone_vslam {

PosePipeline::PosePipeline(const TrackerConfig& tracker, const SlamConfig& slam,
                           const CameraIntrinsics& camera, const Eigen::Isometry3d& T_base_cam,
                           FlightMap::Files maps)
    : config_(slam),
      T_base_cam_(T_base_cam),
      tracker_(tracker, camera),
      map_(std::move(maps)),
      observer_(slam),
      setup_(slam.image_time_offset_s) {
  setup_.useCamera(T_base_cam);
  beginFlight();
  features_.reserve(static_cast<std::size_t>(tracker.corners.features_per_frame));
}

void PosePipeline::beginFlight() {
  slam_.emplace(config_, T_base_cam_);
  const CameraIntrinsics& camera = cameraModel().intrinsics();
  auto map = map_.read({camera.width_px, camera.height_px, cameraModel().focalLength_px()},
                       static_cast<std::size_t>(config_.landmark_map.most()));
  if (map) slam_->load(*std::move(map));
  map_.begin(config_, T_base_cam_);
  slam_->reserveMap();
}

void PosePipeline::startOver() {
  forgetFrame();
  observer_.clear();
  result_ = nullptr;
  ++restarts_;
  map_.beginAnew();
  try {
    beginFlight();
  } catch (const MapFileError& e) {
    std::fprintf(stderr, "vslam_onboard: %s\n", e.what());
    map_.giveUp();
    beginFlight();
  }
}

void PosePipeline::startOverEmpty() {
  slam_.reset();
  map_.giveUp();
  startOver();
}

bool PosePipeline::track(const Frame& frame) {
  const StampGuard::Answer stamp = stamps_.check(frame.stamp_ns);
  if (stamp == StampGuard::Answer::kNotAfter || stamp == StampGuard::Answer::kAlone) return false;
  if (stamp == StampGuard::Answer::kRestart) startOver();
  const std::int64_t begun_ns = clock_ns(CLOCK_PROCESS_CPUTIME_ID);
  tracker_.process(frame.image, frame.stamp_ns, features_);
  waiting_since_ns_ = begun_ns;
  return true;
}

PosePipeline::Answer PosePipeline::localise() {
  using Lookup = OdometryBuffer::Lookup;
  OdometryState state;
  const Lookup lookup =
      observer_.at(setup_.clock().exposed_ns(features_.stamp_ns), features_.stamp_ns, state);
  const bool may_come = lookup == Lookup::kNotYet || lookup == Lookup::kEmpty;
  if (may_come && !observer_.isOver()) return Answer::kNotYet;
  const std::int64_t begun_ns = waiting_since_ns_.value();
  forgetFrame();
  if (lookup != Lookup::kFound) return Answer::kNever;
  setup_.see(features_, observer_.buffer(), *slam_);
  const FrameClock cpu_ms = [begun_ns] {
    return static_cast<double>(clock_ns(CLOCK_PROCESS_CPUTIME_ID) - begun_ns) * 1e-6;
  };
  result_ = &slam_->process(features_, state, {}, cpu_ms);
  map_.see(features_, state, *result_, slam_->landmarks());
  return Answer::kPose;
}

}  // namespace ardrone_vslam
