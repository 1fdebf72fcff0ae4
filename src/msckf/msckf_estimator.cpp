// SPDX-License-Identifier: BSD-3-Clause
#include "msckf/msckf_estimator.hpp"

#include <algorithm>
#include <utility>

#include "association/associator.hpp"
#include "map_update/image_parts.hpp"
#include "msckf/map_snapshot.hpp"

namespace ardrone_vslam {
namespace {

// Odometry drifts otherwise than it claims: after so long without a fix the pose's sigma counts
// twice in the search, after twice as long three times.
constexpr double kWidening_s = 10;
const std::vector<UsedTrack> kNoTracks;

}  // namespace

MsckfEstimator::MsckfEstimator(const SlamConfig& config, const Eigen::Isometry3d& T_base_cam)
    : config_(config),
      T_rig_cam_(T_base_cam),
      filter_(config.msckf, T_base_cam),
      locator_(LocatorConfig{}),
      mapper_(config.mapper) {}

void MsckfEstimator::heed(const SetupFinding& finding) {
  unconfirmed_.heed(finding);
  filter_.heed(finding);
}

void MsckfEstimator::changeCamera(const Eigen::Isometry3d& T_base_cam) {
  T_rig_cam_ = T_base_cam;
  filter_.changeCamera(T_base_cam);
}

void MsckfEstimator::predict(const OdometryState& odometry,
                             const std::optional<OdometryStep>& step) {
  time_since_fix_.see(odometry.stamp_ns);
  OdometryState moved = odometry;  // for the filter, odom is the frame that it works in
  moved.T_odom_base = T_filter_odom_ * odometry.T_odom_base;
  if (config_.planar) moved.height_m = 0;  // any constant says that z stays
  std::optional<OdometryStep> moved_step = step;
  if (moved_step) {
    moved_step->jump_odom_m = T_filter_odom_.linear() * step->jump_odom_m;
    moved_step->motion_odom_m = T_filter_odom_.linear() * step->motion_odom_m;
  }
  filter_.state().frames().empty() ? filter_.start(moved) : filter_.predict(moved, moved_step);
}

void MsckfEstimator::enterMap(MapEntry&& entry, SavedMap&& loaded, const FrameView& view,
                              LandmarkMap& map) {
  if (config_.msckf.localise_only) fixed_map_.emplace(loaded, entry);
  const LoadedAnchors anchors = anchorsOf(loaded);
  filter_.enterMap(entry, anchors);
  T_filter_odom_ = entry.T_loaded_flight * T_filter_odom_;
  // What this flight has made so far goes along with its anchors.
  applyCorrections(filter_.takeCorrections(view.focalLength_px()), view, map);
  for (const Landmark& landmark : landmarksOf(std::move(loaded), anchors, filter_.newest().stamp_ns,
                                              config_.msckf.fix_min_age_s))
    unconfirmed_.addLoaded(map.add(landmark));
}

bool MsckfEstimator::shift(const Revisit& revisit, const FrameView& view, LandmarkMap& map) {
  if (!filter_.shift(revisit)) return false;
  T_filter_odom_ = revisit.entry.T_loaded_flight * T_filter_odom_;
  applyCorrections(filter_.takeCorrections(view.focalLength_px()), view, map);
  return true;
}

MapSnapshot MsckfEstimator::save(const LandmarkMap& map) const {
  if (fixed_map_) return fixed_map_->snapshotWith(map.all(), filter_.newest().stamp_ns);
  return snapshotOf(filter_.state(), map.all());
}

CameraPose MsckfEstimator::camera() {
  CameraPose camera;
  const Clone& now = filter_.newest();
  camera.T_map_cam.linear() = now.R_map_rig * T_rig_cam_.linear();
  camera.T_map_cam.translation() = now.position_map + now.R_map_rig * T_rig_cam_.translation();
  camera.position_variance_m2 = filter_.covariance().topLeftCorner<3, 3>().trace() / 3;
  camera.drifts = driftsOf(filter_.state());
  time_since_fix_.widen(camera.drifts, kWidening_s);
  return camera;
}

Correction MsckfEstimator::correct(const AssociationResult& matches, const FrameView& view,
                                   const LandmarkMap& map) {
  Correction correction;
  const Eigen::Vector3d camera_offset_map =
      filter_.newest().R_map_rig * T_rig_cam_.translation();  // at the predicted attitude
  state_ = correction.state = fix(matches, view, map);
  judge(matches, map, correction);
  correction.by_landmarks =
      locator_.locate(trusted_, view, map, mapper_.angleSigma_rad(view.focalLength_px()));
  if (correction.by_landmarks) correction.by_landmarks->position_map -= camera_offset_map;
  return correction;
}

SlamState MsckfEstimator::fix(const AssociationResult& matches, const FrameView& view,
                              const LandmarkMap& map) {
  std::vector<LandmarkObservation> seen;
  seen.reserve(matches.matches.size());
  for (const Association& match : matches.matches) {
    const Landmark& landmark = map.all()[static_cast<std::size_t>(match.target)];
    const auto feature = static_cast<std::size_t>(match.feature);
    const double distance_m = (landmark.position_map - view.origin_map()).norm();
    seen.push_back({T_rig_cam_.linear() * view.features().bearing_cam[feature].cast<double>(),
                    landmark.position_map, landmark.covariance_m2.full(), landmark.anchor_id,
                    mismatchThreshold_rad(config_.association, view, landmark, distance_m)});
  }
  switch (filter_.fix(seen, view.focalLength_px())) {
    case FixOutcome::kApplied:
    case FixOutcome::kNotNeeded:
      return SlamState::kLocalised;
    case FixOutcome::kRelocated:
      return SlamState::kRelocated;
    case FixOutcome::kRejected:
      return SlamState::kFixRejected;
    case FixOutcome::kNone:
      break;
  }
  if (filter_.isDistrustful()) return SlamState::kDistrusted;
  return map.size() == 0 ? SlamState::kBuildingMap : SlamState::kTracking;
}

void MsckfEstimator::judge(const AssociationResult& matches, const LandmarkMap& map,
                           Correction& correction) {
  trusted_.clear();
  std::vector<std::uint32_t> anchors;
  std::vector<std::int64_t> made_ns;
  anchors.reserve(matches.matches.size());
  made_ns.reserve(matches.matches.size());
  for (std::size_t i = 0; i < matches.matches.size(); ++i) {
    const Association& match = matches.matches[i];
    const ObservationVerdict verdict = filter_.verdicts()[i];
    if (verdict == ObservationVerdict::kAgrees) {
      const Landmark& landmark = map.all()[static_cast<std::size_t>(match.target)];
      anchors.push_back(landmark.anchor_id);
      made_ns.push_back(landmark.first_seen_ns);
    }
    // A corner found beside its landmark still belongs to it, or it would become another landmark;
    // among the matches of a relocation most are simply wrong.
    const bool is_wrong =
        verdict == ObservationVerdict::kDoubtful ||
        (verdict == ObservationVerdict::kContradicts && state_ == SlamState::kRelocated);
    if (!is_wrong) trusted_.push_back(match);
  }
  if (static_cast<int>(trusted_.size()) < kFewestFixLandmarks) time_since_fix_.passFrame();
  time_since_fix_.link(anchors);
  if (static_cast<int>(made_ns.size()) < kFewestFixLandmarks) return;
  const auto enough = made_ns.begin() + kFewestFixLandmarks - 1;
  std::nth_element(made_ns.begin(), enough, made_ns.end());
  correction.known_since_ns = *enough;
}

MapChanges MsckfEstimator::updateMap(const AssociationResult& matches, FrameView& view,
                                     LandmarkMap& map, FrameBudget& budget) {
  MapChanges changes;
  changes.removed_landmarks = unconfirmed_.judge(map);
  const std::vector<UsedTrack>& used_tracks = filter_.track(view.features(), budget);
  // Landmarks decided on the state, be it that they were rejected: the image's rest stays unsaid.
  const bool is_located = state_ == SlamState::kLocalised || state_ == SlamState::kRelocated ||
                          state_ == SlamState::kFixRejected;
  const bool is_by_tracks = state_ == SlamState::kTracking || state_ == SlamState::kBuildingMap;
  const bool is_first = filter_.state().frames().size() == 1;  // which has no tracks yet
  const bool goes_on = is_first || view.features().tracked() >= kFewestFeatures;
  if (is_by_tracks && filter_.used() == 0 && !goes_on) changes.state = SlamState::kBlind;
  const CameraMotion motion = filter_.motion();
  if (!is_located && motion == CameraMotion::kResting) changes.state = SlamState::kResting;
  if (!is_located && motion == CameraMotion::kRotating) changes.state = SlamState::kRotating;
  moveTo(camera(), view);
  if (config_.msckf.localise_only) {
    followTracks(view, trusted_, map);
  } else {
    const bool is_left_out = budget.hasLeftOut(OptionalWork::kLandmarks);  // else made twice
    changeLandmarks(matches, is_left_out ? kNoTracks : used_tracks, view, map, changes);
  }
  changes.feature_candidates = filter_.candidates();
  changes.feature_matches = filter_.used();
  changes.is_keyframe = filter_.isKeyframe();
  return changes;
}

void MsckfEstimator::changeLandmarks(const AssociationResult& matches,
                                     const std::vector<UsedTrack>& used, const FrameView& view,
                                     LandmarkMap& map, MapChanges& changes) {
  applyCorrections(filter_.takeCorrections(view.focalLength_px()), view, map);
  Mapper::remember(view, trusted_, map);
  for (const Association& match : trusted_) {
    const Landmark& landmark = map.all()[static_cast<std::size_t>(match.target)];
    filter_.assignLandmark(landmark.track_id, landmark.id);
  }
  ImageParts known;
  if (!used.empty()) known = knownParts(view, trusted_, config_.msckf.fix_min_age_s, map);
  const std::vector<int> failed =
      takeFailed(matches, trusted_, filter_.verdicts(), state_ == SlamState::kRelocated, view, map);
  changes.removed_landmarks += mapper_.countFailed(failed, map);
  for (const UsedTrack& one : used) {
    if (const Landmark* landmark = map.find(one.track.landmark_id)) {
      renew(one, view, config_.msckf, *landmark, map);
    } else if (isWellKnown(one, view) && !isSeenIn(known, view, one.point.position_map)) {
      filter_.assignLandmark(one.track.track_id, map.add(landmarkOf(one, view)));
      unconfirmed_.add(view.features().stamp_ns);
      ++changes.new_landmarks;
    }
  }
}

Estimate MsckfEstimator::estimate() const {
  Estimate estimate;
  estimate.T_map_base = filter_.T_map_base();
  estimate.covariance = filter_.covariance();
  estimate.fix_nis = filter_.fixNis();
  estimate.track_nis = filter_.trackNis();
  estimate.velocity_bias_sigma_m_s = filter_.learned().bias.sigma_m_s();
  estimate.yaw_walk_factor = filter_.learned().yaw.factor();
  estimate.scale_error = filter_.state().scaleError();
  estimate.scale_sigma = filter_.scaleSigma();
  estimate.height = filter_.heightOutcome();
  estimate.doubtful_way_m = filter_.doubtfulWay_m();
  if (fixed_map_) fixed_map_->addErrors(estimate);
  return estimate;
}

}  // namespace ardrone_vslam
