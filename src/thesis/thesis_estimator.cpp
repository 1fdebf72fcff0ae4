// SPDX-License-Identifier: BSD-3-Clause
#include "thesis/thesis_estimator.hpp"

#include <cmath>

namespace ardrone_vslam {
namespace {

// Of the odometry's attitude, which the thesis takes as it is: for the published covariance alone.
constexpr double kAttitudeSigma_deg = 0.3;

SlamConfig used(SlamConfig config) {
  if (config.thesis_filter.as_printed) config.thesis_filter = asPrinted(config.thesis_filter);
  return config;
}

}  // namespace

ThesisEstimator::ThesisEstimator(const SlamConfig& config, const Eigen::Isometry3d& T_base_cam)
    : config_(used(config)),
      T_base_cam_(T_base_cam),
      filter_(config_.thesis_filter),
      locator_(config_.thesis_filter),
      mapper_(config.mapper),
      associator_(config.association),
      feature_map_(config.feature_map) {}

void ThesisEstimator::predict(const OdometryState& odometry,
                              const std::optional<OdometryStep>& /*step*/) {
  started_ ? filter_.predict(odometry)
           : filter_.start(odometry.T_odom_base.translation(), odometry);
  started_ = true;
  T_odom_base_ = odometry.T_odom_base;
}

CameraPose ThesisEstimator::camera() {
  CameraPose camera;
  const Estimate now = estimate();
  camera.T_map_cam = now.T_map_base * T_base_cam_;
  if (config_.planar) camera.T_map_cam.translation().z() = 0;
  camera.position_variance_m2 = now.covariance.topLeftCorner<3, 3>().trace() / 3;
  camera.common_drift = config_.thesis_filter.common_drift;
  return camera;
}

Correction ThesisEstimator::correct(const AssociationResult& matches, const FrameView& view,
                                    const LandmarkMap& map) {
  Correction correction;
  if (is_refused_) return {SlamState::kDistrusted, std::nullopt, std::nullopt};
  auto fix =
      locator_.locate(matches.matches, view, map, mapper_.angleSigma_rad(view.focalLength_px()));
  if (!fix) {
    correction.state = map.size() == 0 ? SlamState::kBuildingMap : SlamState::kTooFewLandmarks;
    return correction;
  }
  Eigen::Vector3d camera_offset_map = T_odom_base_.linear() * T_base_cam_.translation();
  if (config_.planar) camera_offset_map.z() = 0;
  fix->position_map -= camera_offset_map;  // of the base
  if (config_.planar) fix->position_map.z() = filter_.position_map().z();
  correction.by_landmarks = fix;
  correction.state = filter_.fuse(*fix) ? SlamState::kLocalised : SlamState::kFixRejected;
  return correction;
}

MapChanges ThesisEstimator::updateMap(const AssociationResult& matches, FrameView& view,
                                      LandmarkMap& map, FrameBudget& /*budget*/) {
  MapChanges changes;
  if (is_refused_) return changes;
  moveTo(camera(), view);
  used_.assign(view.size(), false);
  for (const Association& match : matches.matches)
    used_[static_cast<std::size_t>(match.feature)] = true;
  mapper_.refine(view, matches.matches, map);
  // An image that shows nothing (dark, lens covered) says nothing about the landmarks either.
  if (view.size() > 0) changes.removed_landmarks = mapper_.countMissed(matches.missed, map);

  associator_.match(view, feature_map_, used_, feature_matches_);
  changes.new_landmarks =
      mapper_.triangulateMatches(view, feature_matches_.matches, feature_map_, map, used_);
  mapper_.storeRest(view, used_, feature_map_);
  feature_map_.compact(view.features().stamp_ns);
  changes.feature_candidates = feature_matches_.candidates;
  changes.feature_matches = static_cast<int>(feature_matches_.matches.size());
  changes.map_features = static_cast<int>(feature_map_.size());
  return changes;
}

Estimate ThesisEstimator::estimate() const {
  Estimate estimate;
  estimate.T_map_base = T_odom_base_;  // orientation: the odometry's, drift-free
  estimate.T_map_base.translation() = filter_.position_map();
  const double attitude_rad = kAttitudeSigma_deg * M_PI / 180;
  estimate.covariance.topLeftCorner<3, 3>() = filter_.covariance();
  estimate.covariance.bottomRightCorner<3, 3>() =
      attitude_rad * attitude_rad * Eigen::Matrix3d::Identity();
  return estimate;
}

}  // namespace ardrone_vslam
