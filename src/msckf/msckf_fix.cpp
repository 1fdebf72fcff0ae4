// SPDX-License-Identifier: BSD-3-Clause
// Corrections by landmarks of earlier visits.
#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "map_update/relocation.hpp"
#include "msckf/msckf.hpp"

namespace ardrone_vslam {
namespace {

/// Wrong matches from narrower windows do little harm.
constexpr double kHarmlessWindow_rad = 0.05;
constexpr double kMostByChance = 0.1;

double medianWindow_rad(const std::vector<MapObservation>& observations) {
  std::vector<double> windows_rad;
  for (const MapObservation& s : observations) windows_rad.push_back(s.window_rad);
  const auto middle = windows_rad.begin() + static_cast<std::ptrdiff_t>(windows_rad.size() / 2);
  std::nth_element(windows_rad.begin(), middle, windows_rad.end());
  return *middle;
}

}  // namespace

FixOutcome Msckf::fix(const std::vector<LandmarkObservation>& observations,
                      double focal_length_px) {
  verdicts_.assign(observations.size(), ObservationVerdict::kUnjudged);
  if (isDistrustful()) return FixOutcome::kNone;
  fix_outcome_ = fixByObservations(observations, config_.track_sigma_px / focal_length_px);
  return fix_outcome_;
}

FixOutcome Msckf::fixByObservations(const std::vector<LandmarkObservation>& observations,
                                    double sigma_a) {
  const double widest_rad = config_.relocation_window_deg * M_PI / 180;
  std::vector<MapObservation> old;
  std::vector<MapObservation> wide;
  for (std::size_t i = 0; i < observations.size(); ++i) {
    const LandmarkObservation& s = observations[i];
    const auto anchor = anchorOf(s.anchor_id);
    if (!anchor) continue;
    const auto age_ns = newest().stamp_ns - state_.anchors()[*anchor].stamp_ns;
    if (static_cast<double>(age_ns) * 1e-9 < config_.fix_min_age_s) continue;
    old.push_back({s.bearing_base, s.point_map, s.covariance_m2, *anchor, i, s.window_rad});
    if (s.window_rad <= widest_rad) continue;
    wide.push_back(old.back());
    verdicts_[i] = ObservationVerdict::kDoubtful;
  }
  // The wide ones first: of a map that was begun anew meanwhile they are seldom the most.
  const FixOutcome by_few = fixByFew(wide, sigma_a);
  if (by_few == FixOutcome::kRelocated) return by_few;
  const FixOutcome by_most = fixByMost(old, sigma_a);
  if (by_most == FixOutcome::kNone) return by_few;
  if (by_most != FixOutcome::kRejected) return by_most;
  // The odometry is more wrong than it claims, or the landmarks are: more than chance decides.
  const FixOutcome by_all = fixByFew(old, sigma_a);
  return by_all == FixOutcome::kNone ? by_most : by_all;
}

FixOutcome Msckf::fixByFew(const std::vector<MapObservation>& observations, double sigma_a) {
  if (static_cast<int>(observations.size()) < config_.min_fix_landmarks) return FixOutcome::kNone;
  const auto consensus =
      relocate(newest(), camera_base_, observations, sigma_a, attitudeSigma_rad(observations));
  if (!consensus || static_cast<int>(consensus->observations.size()) < config_.min_fix_landmarks)
    return FixOutcome::kNone;
  const FixOutcome outcome = apply(*consensus, sigma_a, config_.relocation_gate_sigmas);
  if (outcome != FixOutcome::kRejected) judge(observations, *consensus);
  return outcome == FixOutcome::kApplied ? FixOutcome::kRelocated : outcome;
}

FixOutcome Msckf::fixByMost(const std::vector<MapObservation>& observations, double sigma_a) {
  if (static_cast<int>(observations.size()) < config_.min_fix_landmarks) return FixOutcome::kNone;
  const ObservationConsensus consensus =
      agreeOnPosition(newest(), camera_base_, observations, sigma_a);
  // In windows some wrong matches agree by chance, but not most of all.
  if (static_cast<int>(consensus.observations.size()) < config_.min_fix_landmarks ||
      2 * consensus.observations.size() < observations.size())
    return FixOutcome::kNone;
  // Of a place that was hardly seen before there are few matches, and then most may agree as well.
  Clone agreed = newest();
  agreed.position_map = consensus.position_map;
  if (medianWindow_rad(observations) > kHarmlessWindow_rad &&
      chanceExplains(agreed, camera_base_, observations, consensus.observations.size(), sigma_a,
                     kMostByChance))
    return FixOutcome::kNone;
  const FixOutcome outcome = apply(consensus, sigma_a, config_.fix_gate_sigmas);
  if (outcome != FixOutcome::kRejected) judge(observations, consensus);
  return outcome;
}

FixOutcome Msckf::apply(const ObservationConsensus& consensus, double sigma_a, double gate_sigmas) {
  MapFix fix = fixBy(state_, camera_base_, consensus, sigma_a, config_.fix_independent_landmarks);
  consistency_.learn(fix.whitened(), fixCoordinates());
  fix_was_compared_ = true;
  state_.inflate(consistency_.odometryFactor());
  if (fix.drift.topLeftCorner<3, 3>().trace() <
      config_.fix_drift_share * fix.covariance.topLeftCorner<3, 3>().trace())
    return FixOutcome::kNotNeeded;
  if (!(fix.distance() < fixCoordinates() * gate_sigmas * gate_sigmas))
    return FixOutcome::kRejected;
  fix.information.matrix /= consistency_.mapFactor();
  fix.information.vector /= consistency_.mapFactor();
  return state_.update(fix.information) ? FixOutcome::kApplied : FixOutcome::kRejected;
}

void Msckf::judge(const std::vector<MapObservation>& observations,
                  const ObservationConsensus& consensus) {
  for (const MapObservation& s : observations)
    verdicts_[s.index] = ObservationVerdict::kContradicts;
  for (const MapObservation& s : consensus.observations)
    verdicts_[s.index] = ObservationVerdict::kAgrees;
}

double Msckf::attitudeSigma_rad(const std::vector<MapObservation>& observations) const {
  const int newest = state_.frameCoordinate(state_.frames().size() - 1);
  std::vector<bool> is_seen(state_.anchors().size(), false);
  for (const MapObservation& s : observations) is_seen[s.anchor] = true;
  double variance_rad2 = 0;
  for (std::size_t i = 0; i < is_seen.size(); ++i) {
    if (!is_seen[i]) continue;
    const Matrix6d relative = state_.relativeCovariance(newest, state_.anchorCoordinate(i));
    variance_rad2 = std::max(variance_rad2, relative.bottomRightCorner<3, 3>().trace() / 3);
  }
  return std::sqrt(variance_rad2);
}

}  // namespace ardrone_vslam
