// SPDX-License-Identifier: BSD-3-Clause
#include "heights/height_update.hpp"

#include <cmath>

#include "linear/scalars.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kGateSigmas = 3;  // a height that disagrees by more is rejected

}  // namespace

HeightUpdate::HeightUpdate(const HeightConfig& config) : config_(config) {
  validate(config);
}

void HeightUpdate::apply(WindowState& state) {
  const auto& height_m = state.newest().height_m;
  outcome_ = height_m ? apply(*height_m, state) : HeightOutcome::kNone;
}

HeightOutcome HeightUpdate::apply(double height_m, WindowState& state) {
  const Clone& newest = state.frames().back();
  const double floor_map_m = newest.position_map.z() - height_m;
  const double variance_m2 = config_.height_sigma_m * config_.height_sigma_m;
  if (!has_floor_) {
    has_floor_ = true;
    used_ns_ = newest.stamp_ns;
    state.beginFloor(height_m, variance_m2);
    return HeightOutcome::kNewFloor;
  }
  if (seconds(newest.stamp_ns - used_ns_) < config_.height_interval_s) return HeightOutcome::kNone;
  used_ns_ = newest.stamp_ns;

  const int z = state.frameCoordinate(state.frames().size() - 1) + 2;
  const auto P = state.covariance();
  constexpr int kFloor = WindowState::kFloor;
  const double innovation_m = state.floor_map_m() - floor_map_m;
  const double expected_m2 = P(z, z) + P(kFloor, kFloor) - 2 * P(z, kFloor) + variance_m2;
  const double gate = kGateSigmas;
  if (innovation_m * innovation_m < gate * gate * expected_m2) {
    is_rejecting_ = false;
    // height = z - floor
    Information information({kFloor, z});
    information.matrix << 1, -1, -1, 1;
    information.matrix /= variance_m2;
    information.vector << -innovation_m / variance_m2, innovation_m / variance_m2;
    return state.update(information) ? HeightOutcome::kApplied : HeightOutcome::kRejected;
  }
  if (!agreesWithRejected(floor_map_m)) {
    is_rejecting_ = true;
    rejecting_since_ns_ = newest.stamp_ns;
  }
  rejected_floor_map_m_ = floor_map_m;
  if (seconds(newest.stamp_ns - rejecting_since_ns_) < config_.floor_step_s)
    return HeightOutcome::kRejected;
  is_rejecting_ = false;
  state.beginFloor(height_m, variance_m2);
  return HeightOutcome::kNewFloor;
}

bool HeightUpdate::agreesWithRejected(double floor_map_m) const {
  return is_rejecting_ &&
         std::abs(floor_map_m - rejected_floor_map_m_) < kGateSigmas * config_.height_sigma_m;
}

}  // namespace ardrone_vslam
