// SPDX-License-Identifier: BSD-3-Clause
// Localisation and mapping with `estimator: constraint`.
#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "pipeline/slam_state.hpp"

namespace ardrone_vslam {
namespace {

/// Of points seen along a baseline that the odometry's velocity error may have made (a drone that
/// turns on the spot, the camera at its nose): all of them are so much nearer or further, which
/// shows only from elsewhere.
Eigen::Matrix3d covarianceByStretch(double stretch_sigma, const Eigen::Vector3d& offset) {
  constexpr double kLittle = 0.1;
  constexpr double kCaution = 3;  // a velocity error is one draw for all of them
  if (stretch_sigma < kLittle) return Eigen::Matrix3d::Zero();
  return std::pow(kCaution * stretch_sigma, 2) * offset * offset.transpose();
}

Landmark landmarkOf(const UsedTrack& used, const FrameView& view) {
  Landmark landmark;
  const Eigen::Vector3d offset = used.point.position_map - view.origin_map();
  const Eigen::Matrix3d by_stretch = covarianceByStretch(used.stretch_sigma, offset);
  const double variance_m2 = used.point.covariance_m2.trace() + by_stretch.trace();
  landmark.position_map = used.point.position_map;
  landmark.covariance_m2 = used.covariance_m2 + by_stretch;
  landmark.anchor_id = used.anchor_id;
  landmark.sigma_m = std::sqrt(variance_m2 / 3);
  landmark.depth_sigma_m = std::sqrt(variance_m2);
  landmark.parallax_rad = used.point.parallax_rad;
  landmark.position_variance_m2 = view.positionVariance_m2();
  landmark.track_id = used.track.track_id;
  landmark.descriptor = used.track.descriptor;
  landmark.seen_distance_m = offset.norm();
  landmark.view_direction_map = offset.normalized();
  landmark.first_seen_ns = view.features().stamp_ns;
  landmark.last_seen_ns = view.features().stamp_ns;
  landmark.times_seen = static_cast<int>(used.track.views.size());
  return landmark;
}

}  // namespace

void Slam::State::setDrifts() {
  std::vector<AnchorDrift> drifts = constraint->drifts();
  time_since_fix.widen(drifts, config.association.widening_s);
  view.setDrifts(std::move(drifts));
}

// A frame's search is widened by the blind time before the last frame, so that odometry that is as
// good as it claims has narrow windows; but a gap is blind from its beginning.
void Slam::State::passGap(std::int64_t stamp_ns) {
  constexpr double kGap_s = 0.5;  // slower cameras are searched as after a gap
  unclocked_s = last_stamp_ns ? static_cast<double>(stamp_ns - *last_stamp_ns) * 1e-9 : 0;
  last_stamp_ns = stamp_ns;
  if (unclocked_s < kGap_s) return;
  time_since_fix.pass(unclocked_s);
  unclocked_s = 0;
}

void Slam::State::fixByLandmarks() {
  if (constraint->isDistrustful()) {
    landmark_matches = {};
    judgeMatches();
    result.state = SlamState::kDistrusted;
    return;
  }
  std::vector<LandmarkObservation> seen;
  seen.reserve(landmark_matches.matches.size());
  for (const Association& match : landmark_matches.matches) {
    const Landmark& landmark = landmark_map.all()[static_cast<std::size_t>(match.target)];
    const auto feature = static_cast<std::size_t>(match.feature);
    const double distance_m = (landmark.position_map - view.origin_map()).norm();
    seen.push_back({T_base_cam.linear() * view.features().bearing_cam[feature].cast<double>(),
                    landmark.position_map, landmark.covariance_m2, landmark.anchor_id,
                    associator.threshold_rad(view, landmark, distance_m)});
  }
  switch (constraint->fix(seen, view.focalLength_px())) {
    case FixOutcome::kApplied:
    case FixOutcome::kNotNeeded:
      result.state = SlamState::kLocalised;
      break;
    case FixOutcome::kRelocated:
      result.state = SlamState::kRelocated;
      break;
    case FixOutcome::kRejected:
      result.state = SlamState::kFixRejected;
      break;
    case FixOutcome::kNone:
      result.state = landmark_map.size() == 0 ? SlamState::kBuildingMap : SlamState::kTracking;
      break;
  }
  judgeMatches();
}

void Slam::State::judgeMatches() {
  trusted_matches.clear();
  std::vector<std::uint32_t> anchors;
  for (std::size_t i = 0; i < landmark_matches.matches.size(); ++i) {
    const Association& match = landmark_matches.matches[i];
    const ObservationVerdict verdict = constraint->verdicts()[i];
    if (verdict == ObservationVerdict::kAgrees)
      anchors.push_back(landmark_map.all()[static_cast<std::size_t>(match.target)].anchor_id);
    // A corner found beside its landmark still belongs to it, or it would become another landmark;
    // among the matches of a relocation most are simply wrong.
    const bool is_wrong =
        verdict == ObservationVerdict::kDoubtful ||
        (verdict == ObservationVerdict::kContradicts && result.state == SlamState::kRelocated);
    if (!is_wrong) trusted_matches.push_back(match);
  }
  const bool is_blind = static_cast<int>(trusted_matches.size()) < config.msckf.min_fix_landmarks;
  if (is_blind) time_since_fix.pass(unclocked_s);
  time_since_fix.link(anchors);
  locate(trusted_matches);
}

int Slam::State::dropFailing() {
  // A place is in view when some of its landmarks are found; behind a wall none of them is.
  constexpr int kOneIn = 10;
  struct Place {
    int found = 0;
    int missed = 0;
  };
  std::unordered_map<std::uint32_t, Place> places;
  const auto anchorOf = [this](int target) {
    return landmark_map.all()[static_cast<std::size_t>(target)].anchor_id;
  };
  for (const Association& match : trusted_matches) ++places[anchorOf(match.target)].found;
  for (const int target : landmark_matches.missed) ++places[anchorOf(target)].missed;
  std::vector<int> failed;
  for (const int target : landmark_matches.missed) {
    const Place& place = places[anchorOf(target)];
    if (kOneIn * place.found >= place.found + place.missed) failed.push_back(target);
  }
  for (std::size_t i = 0; i < landmark_matches.matches.size(); ++i) {
    if (constraint->verdicts()[i] != ObservationVerdict::kContradicts) continue;
    const int target = landmark_matches.matches[i].target;
    failed.push_back(target);
    // It was remembered, but not as a observation that speaks for it.
    if (result.state != SlamState::kRelocated)
      --landmark_map.atPlace(static_cast<std::size_t>(target)).times_seen;
  }
  return mapper.countFailed(failed, landmark_map);
}

void Slam::State::moveLandmarks() {
  const std::vector<AnchorCorrection> moves = constraint->takeMoves(view.focalLength_px());
  if (moves.empty()) return;
  // Most landmarks stay where they are and are not touched; their anchors lie close together in
  // the columns.
  const LandmarkColumns& columns = landmark_map.columns(view.origin_map());
  // Neighbours mostly belong to one anchor.
  std::uint32_t anchor_id = 0;
  auto move = moves.end();
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const std::uint32_t its_anchor = columns.anchorId(i);
    if (its_anchor != anchor_id) {
      anchor_id = its_anchor;
      move = std::find_if(moves.begin(), moves.end(), [anchor_id](const AnchorCorrection& one) {
        return one.anchor_id == anchor_id;
      });
    }
    if (move != moves.end()) move->apply(landmark_map.atPlace(i));
  }
}

bool Slam::State::isWellKnown(const UsedTrack& one) const {
  const double distance_m = (one.point.position_map - view.origin_map()).norm();
  return std::sqrt(one.covariance_m2.trace()) < config.msckf.landmark_sigma * distance_m;
}

void Slam::State::renew(const UsedTrack& one, const Landmark& landmark) {
  // Its place beside the old anchor is forgotten: the drift since then must be worth it, too, and
  // once it gives fixes it stays where it is.
  constexpr double kBetter = 0.5;  // in variance
  const double age_s =
      static_cast<double>(view.features().stamp_ns - landmark.first_seen_ns) * 1e-9;
  if (age_s > config.msckf.fix_min_age_s) return;
  const double distance_m = (one.point.position_map - view.origin_map()).norm();
  const double drift_m =
      distance_m *
      view.driftAngle_rad(landmark.anchor_id, landmark.position_variance_m2, distance_m);
  if (one.covariance_m2.trace() + 3 * drift_m * drift_m > kBetter * landmark.covariance_m2.trace())
    return;
  Landmark better = landmarkOf(one, view);
  better.id = landmark.id;
  better.descriptor = landmark.descriptor;
  better.first_seen_ns = landmark.first_seen_ns;
  better.times_seen += landmark.times_seen;
  landmark_map.atPlace(static_cast<std::size_t>(&landmark - landmark_map.all().data())) = better;
}

void Slam::State::useTracks(const ImageFeatures& features) {
  const std::vector<UsedTrack>& used_tracks = constraint->track(features);
  const bool is_located = result.state == SlamState::kLocalised ||
                          result.state == SlamState::kRelocated ||
                          result.state == SlamState::kFixRejected;
  if (!is_located && constraint->motion() == CameraMotion::kResting)
    result.state = SlamState::kResting;
  if (!is_located && constraint->motion() == CameraMotion::kRotating)
    result.state = SlamState::kRotating;
  view.setOrigin(constraint->newest().position_map +
                 constraint->newest().R_map_rig * T_base_cam.translation());
  setVariance();
  moveLandmarks();
  Mapper::remember(view, trusted_matches, landmark_map);
  for (const Association& match : trusted_matches) {
    const Landmark& landmark = landmark_map.all()[static_cast<std::size_t>(match.target)];
    constraint->assignLandmark(landmark.track_id, landmark.id);
  }
  result.removed_landmarks = dropFailing();
  for (const UsedTrack& one : used_tracks) {
    if (const Landmark* landmark = landmark_map.find(one.track.landmark_id)) {
      renew(one, *landmark);
    } else if (isWellKnown(one)) {
      constraint->assignLandmark(one.track.track_id, landmark_map.add(landmarkOf(one, view)));
      ++result.new_landmarks;
    }
  }
  result.removed_landmarks += landmark_map.enforceCap();
}

}  // namespace ardrone_vslam
