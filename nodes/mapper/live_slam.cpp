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

LiveSlam::InUse::InUse(const SlamConfig& config, const Eigen::Isometry3d& T_base_cam)
    : slam(config, T_base_cam),
      recorder(config, T_base_cam, kMostOfFlight_bytes),
      loaded_map(config.msckf) {}

void LiveSlam::useCamera(const CameraIdentity& camera, const Eigen::Isometry3d& T_base_cam,
                         const std::string& base, const std::string& frame) {
  if (in_use_) {
    in_use_->slam.changeCamera(T_base_cam);
    in_use_->recorder.useCamera(T_base_cam);
  } else {
    in_use_.emplace(config_, T_base_cam);
    if (loaded_) in_use_->slam.load(*loaded_);
  }
  setup_.useCamera(T_base_cam, base, frame);
  camera_ = camera;
  T_base_cam_ = T_base_cam;
}

void LiveSlam::useMap(std::shared_ptr<const SavedMap> loaded) {
  std::string fault = faultOfMaps(config_, loaded ? loaded->landmarks.size() : 0);
  if (fault.empty() && loaded && in_use_) fault = differenceOf(*loaded, camera_);
  if (loaded && !fault.empty()) throw MapFileError(fault);
  loaded_ = std::move(loaded);
}

std::string LiveSlam::mapFault(const CameraIdentity& camera) const {
  return loaded_ && !in_use_ ? differenceOf(*loaded_, camera) : "";
}

MapSnapshot LiveSlam::save() const {
  if (in_use_ && !in_use_->slam.hasWholeMap())
    throw MapFileError(std::string("nothing is saved: ") + explain(SlamState::kSearchingMap));
  MapSnapshot map = in_use_ ? in_use_->slam.save() : MapSnapshot();
  if (map.landmarks.empty()) throw MapFileError("there is no landmark to save: fly first");
  map.all_but_landmarks.flight = in_use_->recorder.record();
  return map;
}

void LiveSlam::lookNear(const PlaceHint& hint) {
  if (!in_use_) throw MapFileError("no image has come yet; say it again when one has");
  in_use_->slam.lookNear(hint);
}

void LiveSlam::change(const LandmarkMapConfig& landmark_map, const FrameBudgetConfig& frame_budget,
                      const LoadedMapConfig& loaded_map) {
  SlamConfig changed = config_;
  changed.landmark_map = landmark_map;
  changed.frame_budget = frame_budget;
  changed.msckf.localise_only = loaded_map.localise_only;
  const std::string fault = faultOfMaps(changed, loaded_ ? loaded_->landmarks.size() : 0);
  if (loaded_ && !fault.empty()) throw std::invalid_argument(fault);
  if (in_use_) in_use_->slam.limit(landmark_map, frame_budget);
  config_ = changed;
}

void LiveSlam::endMap() {
  ++counts_.restarts;
  in_use_.reset();
  answered_ns_ = 0;
}

const FrameResult& LiveSlam::process(const Features& message, OdometryState odometry,
                                     const OdometryBuffer& odometries) {
  toFeatures(message, features_);
  setup_.see(features_, odometries, in_use_->slam);
  odometry.stamp_ns = features_.stamp_ns;  // the pose keeps the image's stamp
  times_ms_ = {};
  StageTimer timer(times_ms_);
  const FrameResult& result =
      in_use_->slam.process(features_, odometry, timer.hook(), StageTimer::clock());
  in_use_->recorder.see(features_, odometry, result, in_use_->slam.landmarks());
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
