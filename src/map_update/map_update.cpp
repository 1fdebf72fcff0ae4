// SPDX-License-Identifier: BSD-3-Clause
#include "map_update/map_update.hpp"

#include <algorithm>
#include <cmath>

#include "linear/scalars.hpp"
#include "map_update/relocation.hpp"

namespace ardrone_vslam {
namespace {

/// Wrong matches from narrower windows do little harm.
constexpr double kHarmlessWindow_rad = 0.05;
constexpr double kMostByChance = 0.1;
// Of landmarks that were looked for further around their prediction a few may fix the pose, too,
// when more agree than chance explains: the pose was lost.
constexpr double kRelocationWindow_deg = 15;
// After a blind stretch the odometry has often drifted more than it claims.
constexpr double kRelocationGateSigmas = 5;
// In the mean of a fix's six coordinates: a fix that disagrees by more is a wrong one.
constexpr double kGateSigmas = 2;
constexpr int kPoseCoordinates = 6;
// A fix waits until the drift's variance is so many times its own, so that the same landmarks do
// not count again and again.
constexpr double kDriftShare = 1;

}  // namespace

void MapUpdate::beginFrame() {
  outcome_ = FixOutcome::kNone;
  was_compared_ = false;
}

FixOutcome MapUpdate::apply(const std::vector<LandmarkObservation>& observations,
                            const Eigen::Vector3d& camera_rig, double focal_length_px,
                            Propagator& propagator, WindowState& state) {
  skip(observations.size());
  Frame frame{camera_rig, config_.track_sigma_px / focal_length_px, propagator, state};
  return outcome_ = fix(observations, frame);
}

void MapUpdate::skip(std::size_t observations) {
  verdicts_.assign(observations, ObservationVerdict::kUnjudged);
}

bool MapUpdate::isLocated() const {
  return outcome_ == FixOutcome::kApplied || outcome_ == FixOutcome::kRelocated ||
         outcome_ == FixOutcome::kNotNeeded;
}

std::optional<double> MapUpdate::comparedNis() const {
  return was_compared_ ? std::optional<double>(nis()) : std::nullopt;
}

FixOutcome MapUpdate::fix(const std::vector<LandmarkObservation>& observations, Frame& frame) {
  const double widest_rad = kRelocationWindow_deg * M_PI / 180;
  const auto& anchors = frame.state.anchors();
  std::vector<MapObservation> old;
  std::vector<MapObservation> wide;
  old.reserve(observations.size());
  for (std::size_t i = 0; i < observations.size(); ++i) {
    const LandmarkObservation& s = observations[i];
    const auto anchor = indexOf(anchors, s.anchor_id);
    if (!anchor) continue;
    const auto age_ns = frame.state.newest().stamp_ns - anchors[*anchor].stamp_ns;
    if (!anchors[*anchor].is_loaded && seconds(age_ns) < config_.fix_min_age_s) continue;
    old.push_back({s.bearing_rig, s.point_map, s.covariance_m2, *anchor, i, s.window_rad});
    if (s.window_rad <= widest_rad) continue;
    wide.push_back(old.back());
    verdicts_[i] = ObservationVerdict::kDoubtful;
  }
  // The wide ones first: of a map that was begun anew meanwhile they are seldom the most.
  const FixOutcome by_few = fixByFew(wide, frame);
  if (by_few == FixOutcome::kRelocated) return by_few;
  const FixOutcome by_most = fixByMost(old, frame);
  if (by_most == FixOutcome::kNone) return by_few;
  if (by_most != FixOutcome::kRejected) return by_most;
  // The odometry is more wrong than it claims, or the landmarks are: more than chance decides.
  const FixOutcome by_all = fixByFew(old, frame);
  return by_all == FixOutcome::kNone ? by_most : by_all;
}

FixOutcome MapUpdate::fixByFew(const std::vector<MapObservation>& observations, Frame& frame) {
  if (static_cast<int>(observations.size()) < kFewestFixLandmarks) return FixOutcome::kNone;
  const auto consensus =
      relocate(frame.state.newest(), frame.camera_rig, observations, frame.angle_sigma_rad,
               attitudeSigma_rad(observations, frame.state));
  if (!consensus || static_cast<int>(consensus->observations.size()) < kFewestFixLandmarks)
    return FixOutcome::kNone;
  const FixOutcome outcome = update(*consensus, kRelocationGateSigmas, frame);
  if (outcome != FixOutcome::kRejected) judge(observations, *consensus);
  return outcome == FixOutcome::kApplied ? FixOutcome::kRelocated : outcome;
}

FixOutcome MapUpdate::fixByMost(const std::vector<MapObservation>& observations, Frame& frame) {
  if (static_cast<int>(observations.size()) < kFewestFixLandmarks) return FixOutcome::kNone;
  const Clone& newest = frame.state.newest();
  const ObservationConsensus consensus =
      agreeOnPosition(newest, frame.camera_rig, observations, frame.angle_sigma_rad);
  // In windows some wrong matches agree by chance, but not most of all.
  if (static_cast<int>(consensus.observations.size()) < kFewestFixLandmarks ||
      2 * consensus.observations.size() < observations.size())
    return FixOutcome::kNone;
  // Of a place that was hardly seen before there are few matches, and then most may agree as well.
  Clone agreed = newest;
  agreed.position_map = consensus.position_map;
  if (medianWindow_rad(observations) > kHarmlessWindow_rad &&
      chanceExplains(agreed, frame.camera_rig, observations, consensus.observations.size(),
                     frame.angle_sigma_rad, kMostByChance))
    return FixOutcome::kNone;
  const FixOutcome outcome = update(consensus, kGateSigmas, frame);
  if (outcome != FixOutcome::kRejected) judge(observations, consensus);
  return outcome;
}

FixOutcome MapUpdate::update(const ObservationConsensus& consensus, double gate_sigmas,
                             Frame& frame) {
  MapFix fix = fixBy(frame.state, frame.camera_rig, consensus, frame.angle_sigma_rad,
                     config_.fix_independent_landmarks);
  const AcrossBlind across = blind_.judge(fix, consensus.observations, frame.state);
  if (across == AcrossBlind::kContradicts) {
    // RevisitSearch looks for them: they must not count as seen where they are thought to be.
    for (const MapObservation& s : consensus.observations)
      verdicts_[s.index] = ObservationVerdict::kDoubtful;
    return FixOutcome::kRejected;
  }
  if (across == AcrossBlind::kAsUsual) {
    consistency_.learn(fix.whitened());
    was_compared_ = true;
    frame.propagator.inflate(consistency_.odometryFactor(), frame.state);
    if (fix.drift.topLeftCorner<3, 3>().trace() <
        kDriftShare * fix.covariance.topLeftCorner<3, 3>().trace())
      return FixOutcome::kNotNeeded;
    if (!(fix.distance() < kPoseCoordinates * squared(gate_sigmas))) return FixOutcome::kRejected;
  }
  fix.information.matrix /= consistency_.mapFactor();
  fix.information.vector /= consistency_.mapFactor();
  return frame.state.update(fix.information) ? FixOutcome::kApplied : FixOutcome::kRejected;
}

void MapUpdate::judge(const std::vector<MapObservation>& observations,
                      const ObservationConsensus& consensus) {
  for (const MapObservation& s : observations)
    verdicts_[s.index] = ObservationVerdict::kContradicts;
  for (const MapObservation& s : consensus.observations)
    verdicts_[s.index] = ObservationVerdict::kAgrees;
}

}  // namespace ardrone_vslam
