// SPDX-License-Identifier: BSD-3-Clause
#include <cassert>
#include <cmath>

#include "conversions/conversions.hpp"

namespace ardrone_vslam {
namespace {

std::uint8_t stateOf(SlamState state) {
  switch (state) {
    case SlamState::kBuildingMap:
      return Status::BUILDING_MAP;
    case SlamState::kLocalised:
      return Status::LOCALISED;
    case SlamState::kTooFewLandmarks:
      return Status::TOO_FEW_LANDMARKS;
    case SlamState::kFixRejected:
      return Status::FIX_REJECTED;
    case SlamState::kOdometryOnly:
      return Status::OBSERVER_ONLY;
    case SlamState::kNotFinite:
      return Status::NOT_FINITE;
    case SlamState::kTracking:
      return Status::TRACKING;
    case SlamState::kResting:
      return Status::RESTING;
    case SlamState::kRotating:
      return Status::ROTATING;
    case SlamState::kDistrusted:
      return Status::DISTRUSTED;
    case SlamState::kRelocated:
      return Status::RELOCATED;
    case SlamState::kSearchingMap:
      return Status::SEARCHING_MAP;
    case SlamState::kBlind:
      return Status::BLIND;
  }
  assert(false && "a SlamState that Status.msg does not know");
  return Status::OBSERVER_ONLY;
}

}  // namespace

bool hasHardlyACorner(const FrameResult& result) {
  return result.features < kFewestFeatures;
}

void sayFirst(const std::string& sentence, Status& status) {
  const bool has_both = !sentence.empty() && !status.reason.empty();
  status.reason = sentence + (has_both ? "; " : "") + status.reason;
}

void toStatus(SlamState state, const LeftOut& left_out, Status& status) {
  status.state = stateOf(state);
  status.state_name = kSlamStateNames[static_cast<std::size_t>(state)];
  const bool is_by_landmarks = state == SlamState::kTracking || state == SlamState::kResting ||
                               state == SlamState::kRotating ||
                               state == SlamState::kTooFewLandmarks;
  // That no landmark was found says nothing when none was looked for.
  const bool has_looked = !isLeftOut(OptionalWork::kLandmarks, left_out);
  status.reason =
      state == SlamState::kLocalised || (is_by_landmarks && !has_looked) ? "" : explain(state);
}

void toStatus(const FrameResult& result, const std::string& map_frame, Status& status) {
  const auto count = [](int number) { return static_cast<std::uint32_t>(number); };
  status.header.stamp = toRosTime(result.stamp_ns);
  status.header.frame_id = map_frame;
  toStatus(result.state, result.left_out, status);
  if (hasHardlyACorner(result) && result.state != SlamState::kBlind) {
    sayFirst("the image has hardly a corner: it is dark, over-exposed, blurred or without texture",
             status);
  }
  status.features = count(result.features);
  status.match_method = nameOf(result.match_method);
  status.landmarks_in_view = count(result.landmarks_in_view);
  status.landmark_candidates = count(result.landmark_candidates);
  status.landmark_matches = count(result.landmark_matches);
  status.feature_candidates = count(result.feature_candidates);
  status.feature_matches = count(result.feature_matches);
  status.landmark_mismatches = count(result.landmark_candidates - result.landmark_matches);
  status.feature_mismatches = count(result.feature_candidates - result.feature_matches);
  status.landmarks = count(result.landmarks);
  status.map_features = count(result.map_features);
  const auto finite = [](double value) { return std::isfinite(value) ? value : 0; };
  status.fix_nis = finite(result.fix_nis);
  status.track_nis = finite(result.track_nis);
  status.velocity_bias_deviation = finite(result.velocity_bias_sigma_m_s);
  status.yaw_walk_factor = finite(result.yaw_walk_factor);
  const bool has_scale = std::isfinite(result.scale_error + result.scale_sigma);
  status.scale_error = has_scale ? result.scale_error : 0;
  status.scale_deviation = has_scale ? result.scale_sigma : 0;
  status.deviation = result.state == SlamState::kNotFinite ? 0 : result.sigma_m;
}

void toStatus(const OdometryFaultCounts& faults, Status& status) {
  status.odometry_fault.assign(EnumNames<OdometryFault>::kNames.begin(),
                               EnumNames<OdometryFault>::kNames.end());
  status.odometry_fault_count.assign(faults.begin(), faults.end());
}

void toStatus(const TimeOffset& estimate, double used_s, Status& status) {
  status.image_time_offset = used_s;
  status.image_time_offset_estimate = estimate.offset_s;
  status.image_time_offset_deviation = estimate.sigma_s;
}

bool isWell(std::uint8_t state) {
  return state == Status::LOCALISED || state == Status::BUILDING_MAP || state == Status::TRACKING ||
         state == Status::RESTING || state == Status::ROTATING || state == Status::RELOCATED ||
         state == Status::OBSERVER_ONLY;
}

}  // namespace ardrone_vslam
