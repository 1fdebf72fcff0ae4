// SPDX-License-Identifier: BSD-3-Clause
#include "mapper/live_slam.hpp"

#include <stdexcept>
#include <string>
#include <utility>

namespace ardrone_vslam {
namespace {

constexpr std::size_t kMostOfFlight_bytes = 32'000'000;

std::string differenceOf(const SavedMap& map, const CameraIdentity& camera) {
  const MapCamera now{static_cast<int>(camera.width_px), static_cast<int>(camera.height_px),
                      camera.focal_length_px};
  return cameraDifference(map.cameras, now);
}

}  // namespace

void LiveSlam::useCamera(const CameraIdentity& camera, const Eigen::Isometry3d& T_base_cam,
                         const std::string& base, const std::string& frame) {
  if (slam_) {
    slam_->changeCamera(T_base_cam);
    recorder_->useCamera(T_base_cam);
  } else {
    slam_ = std::make_unique<Slam>(config_, T_base_cam);
    recorder_.emplace(config_, T_base_cam, kMostOfFlight_bytes);
    if (loaded_) slam_->load(*loaded_);
  }
  setup_.useCamera(T_base_cam, base, frame);
  camera_ = camera;
  T_base_cam_ = T_base_cam;
}

void LiveSlam::useMap(std::shared_ptr<const SavedMap> loaded) {
  std::string fault = faultOfMaps(config_, loaded ? loaded->landmarks.size() : 0);
  if (fault.empty() && loaded && slam_) fault = differenceOf(*loaded, camera_);
  if (loaded && !fault.empty()) throw MapFileError(fault);
  loaded_ = std::move(loaded);
}

std::string LiveSlam::mapFault(const CameraIdentity& camera) const {
  return loaded_ && !slam_ ? differenceOf(*loaded_, camera) : "";
}

MapSnapshot LiveSlam::save() const {
  if (slam_ && !slam_->hasWholeMap())
    throw MapFileError(std::string("nothing is saved: ") + explain(SlamState::kSearchingMap));
  MapSnapshot map = slam_ ? slam_->save() : MapSnapshot();
  if (map.landmarks.empty()) throw MapFileError("there is no landmark to save: fly first");
  map.all_but_landmarks.flight = recorder_->record();
  return map;
}

void LiveSlam::lookNear(const PlaceHint& hint) {
  if (!slam_) throw MapFileError("no image has come yet; say it again when one has");
  slam_->lookNear(hint);
}

void LiveSlam::limit(const LandmarkMapConfig& landmark_map, const FrameBudgetConfig& frame_budget) {
  SlamConfig limited = config_;
  limited.landmark_map = landmark_map;
  limited.frame_budget = frame_budget;
  const std::string fault = faultOfMaps(limited, loaded_ ? loaded_->landmarks.size() : 0);
  if (loaded_ && !fault.empty()) throw std::invalid_argument(fault);
  if (slam_) slam_->limit(landmark_map, frame_budget);
  config_ = limited;
}

void LiveSlam::endMap() {
  ++counts_.restarts;
  slam_.reset();
  answered_ns_ = 0;
}

const FrameResult& LiveSlam::process(const Features& message, OdometryState odometry,
                                     const OdometryBuffer& odometries) {
  toFeatures(message, features_);
  setup_.see(features_, odometries, *slam_);
  odometry.stamp_ns = features_.stamp_ns;  // the pose keeps the image's stamp
  times_ms_ = {};
  StageTimer timer(times_ms_);
  const FrameResult& result =
      slam_->process(features_, odometry, timer.hook(), StageTimer::clock());
  recorder_->see(features_, odometry, result, slam_->landmarks());
  has_answered_ = true;
  if (result.height == HeightOutcome::kRejected) ++counts_.heights_rejected;
  for (std::size_t i = 0; i < counts_.left_out.size(); ++i)
    counts_.left_out[i] += result.left_out[i];
  if (result.state == SlamState::kNotFinite) {
    ++counts_.results_not_finite;
  } else {
    ++counts_.images;
    answered_ns_ = result.stamp_ns;
  }
  return result;
}

bool LiveSlam::endSecond() {
  return std::exchange(has_answered_, false);
}

void LiveSlam::fill(Status& status) const {
  status.images = counts_.images;
  status.heights_rejected = counts_.heights_rejected;
  status.results_not_finite = counts_.results_not_finite;
  status.restarts = counts_.restarts;
  status.camera_changes = counts_.camera_changes;
  status.left_out.assign(kOptionalWorkNames.begin(), kOptionalWorkNames.end());
  status.left_out_count.assign(counts_.left_out.begin(), counts_.left_out.end());
  setup_.fill(status);
}

}  // namespace ardrone_vslam
