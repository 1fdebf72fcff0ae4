// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/frame_results.hpp"

#include <cmath>

namespace ardrone_vslam {

FrameResult resultOf(const Estimate& estimate, const Correction& correction,
                     const MapChanges& changes) {
  FrameResult result;
  result.state = changes.state.value_or(correction.state);
  result.T_map_base = estimate.T_map_base;
  result.covariance = estimate.covariance;
  result.sigma_m = std::sqrt(estimate.covariance.topLeftCorner<3, 3>().trace() / 3);
  result.fix_nis = estimate.fix_nis;
  result.track_nis = estimate.track_nis;
  result.velocity_bias_sigma_m_s = estimate.velocity_bias_sigma_m_s;
  result.yaw_walk_factor = estimate.yaw_walk_factor;
  result.scale_error = estimate.scale_error;
  result.scale_sigma = estimate.scale_sigma;
  result.height = estimate.height;
  if (correction.by_landmarks) {
    result.landmark_position_map = correction.by_landmarks->position_map;
    result.landmark_sigma_m = std::sqrt(correction.by_landmarks->covariance.trace() / 3);
  }
  result.feature_candidates = changes.feature_candidates;
  result.feature_matches = changes.feature_matches;
  result.new_landmarks = changes.new_landmarks;
  result.removed_landmarks = changes.removed_landmarks;
  result.map_features = changes.map_features;
  result.is_keyframe = changes.is_keyframe;
  return result;
}

void noteFeatures(const ImageFeatures& features, FrameResult& result) {
  result.features = static_cast<int>(features.size());
  result.tracks = static_cast<int>(features.tracked());
  result.tracks_aligned = static_cast<int>(features.aligned());
}

void noteMatches(const AssociationResult& matches, FrameResult& result) {
  result.match_method = matches.method;
  result.landmarks_in_view = matches.in_view;
  result.landmark_candidates = matches.candidates;
  result.landmark_matches = static_cast<int>(matches.matches.size());
}

void widenPlace(FrameResult& result, double sigma_m) {
  result.covariance.diagonal().head<3>().array() += sigma_m * sigma_m;
  result.sigma_m = std::sqrt(result.covariance.topLeftCorner<3, 3>().trace() / 3);
}

bool isFinite(const Estimate& estimate) {
  return estimate.T_map_base.matrix().allFinite() && estimate.covariance.allFinite();
}

void forgetPlace(FrameResult& result) {
  constexpr double kAnywhere_m = 1000;
  widenPlace(result, kAnywhere_m);
  result.covariance(5, 5) += M_PI * M_PI / 3;  // any heading
}

bool isFinite(const FrameResult& r) {
  return r.T_map_base.matrix().allFinite() && r.T_odom_base.matrix().allFinite() &&
         (r.T_map_base.translation() - r.T_odom_base.translation()).allFinite() &&
         r.covariance.allFinite() && std::isfinite(r.sigma_m);
}

std::string explain(const LeftOut& left_out) {
  if (left_out.none()) return "";
  std::string names;
  for (std::size_t i = 0; i < kOptionalWorkNames.size(); ++i) {
    if (left_out[i]) names += (names.empty() ? "" : ", ") + std::string(kOptionalWorkNames[i]);
  }
  return "frame_budget_ms leaves no time for all (left out: " + names +
         "): raise it, or lower features_per_frame, max_clones or max_landmarks";
}

const char* explain(SlamState state) {
  switch (state) {
    case SlamState::kBuildingMap:
      return "no landmark yet: they appear when the camera has moved past what it sees by a few "
             "hundredths of the distance; with localise_only and without a loaded map never";
    case SlamState::kLocalised:
      return "";
    case SlamState::kTooFewLandmarks:
      return "fewer landmarks recognised than min_landmarks: the view is new, blurred, dark or "
             "plain; the pose follows the odometry";
    case SlamState::kFixRejected:
      return "the landmarks' position disagrees with the odometry by more than both "
             "claim; the pose follows the odometry";
    case SlamState::kOdometryOnly:
      return "estimator is set to odometry: the odometry is passed on without correction";
    case SlamState::kTracking:
      return "no place seen before is in view: the tracks correct the pose, its drift stays";
    case SlamState::kResting:
      return "the image is still, so the position is held; no place seen before is in view";
    case SlamState::kRotating:
      return "the camera turns on the spot, so the position is held; that shows no distances, so "
             "there are no new landmarks";
    case SlamState::kRelocated:
      return "a place seen before was found again after the pose had become uncertain or wrong; "
             "the pose may have jumped there";
    case SlamState::kDistrusted:
      return "camera and odometry contradict each other by far more than configured, so the "
             "pose follows the odometry for 10 s, each time twice as long: check calibration and "
             "mounting, whether the scene itself moves, and velocity_bias_m_s";
    case SlamState::kSearchingMap:
      return "the flight has not been found in the map yet: look where that was made, from "
             "a like distance; until then the pose is beside another origin";
    case SlamState::kBlind:
      return "hardly a corner goes on from image to image: it is dark, over-exposed, blurred or "
             "without texture; the pose goes on by the odometry's way";
    case SlamState::kNotFinite:
      return "the pose is not finite and is not published; next the flight is looked for in its "
             "map: check odometry, calibration and mounting for absurd values";
  }
  return "";
}

}  // namespace ardrone_vslam
