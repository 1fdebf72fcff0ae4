// SPDX-License-Identifier: BSD-3-Clause
#include "msckf/msckf.hpp"

#include <algorithm>

#include "linear/scalars.hpp"
#include "zero_motion/scene_limit.hpp"

namespace ardrone_vslam {
namespace {

// So far an image moves on before tracks say anything new: a parallax is known to a 15th then.
constexpr double kKeyframeSigmas = 15;  // of a track's corner
constexpr double kKeyframe_s = 2;  // a slow camera drifts meanwhile, so it gets one all the same

}  // namespace

Msckf::Msckf(const MsckfConfig& config, const Eigen::Isometry3d& T_base_cam)
    : config_(config),
      T_rig_cam_(T_base_cam),
      propagator_(config.odometry),
      tracks_(T_base_cam.linear(), config.track_sigma_px, config.track_scene_px),
      track_update_(config),
      map_update_(config),
      height_(config.height),
      anchors_(config) {
  validate(config);
}

void Msckf::start(const OdometryState& odometry) {
  propagator_.start(odometry, state_);
  height_ = HeightUpdate(config_.height);
}

void Msckf::changeCamera(const Eigen::Isometry3d& T_base_cam) {
  track_update_.changeCamera(T_rig_cam_.translation());
  anchors_.changeCamera();
  T_rig_cam_ = T_base_cam;
  tracks_.changeCamera(T_rig_cam_.linear());
  zero_motion_.beginAnew(state_);
  state_.beginExtrinsics(squared(radians(config_.odometry.extrinsics_sigma_deg)));
}

void Msckf::enterMap(const MapEntry& entry, const LoadedAnchors& loaded) {
  zero_motion_.beginAnew(state_);  // it remembers odometry in the old frame
  MapEntrance(state_).enter(entry, loaded);
  moveOdometry(entry.T_loaded_flight);
  anchors_.useLoaded(loaded.anchors);
}

bool Msckf::shift(const Revisit& revisit) {
  if (isDistrustful()) return false;
  zero_motion_.beginAnew(state_);
  while (state_.frames().size() > 1 && revisit.shareOf(state_.frames().front()) == 0)
    dropOldest();  // it stays, and tracks would tie the newest to it
  if (!indexOf(state_.anchors(), revisit.anchor_id) && !indexOf(state_.frames(), revisit.anchor_id))
    return false;            // joined to another meanwhile
  Revisit spread = revisit;  // tracks tie the window's frames to each other: they move alike
  spread.to_ns = std::max(spread.from_ns, std::min(spread.to_ns, state_.frames().front().stamp_ns));
  MapEntrance(state_).shift(spread);
  moveOdometry(revisit.entry.T_loaded_flight);
  return true;
}

void Msckf::moveOdometry(const Eigen::Isometry3d& T_new_old) {
  map_update_.blindStretch().forget();
  propagator_.moveOdometry(T_new_old);
  watchdog_.moveInto(T_new_old);
}

void Msckf::predict(const OdometryState& odometry, const std::optional<OdometryStep>& step) {
  const bool is_kept = isKeyframe() || zero_motion_.isReference(newest().id);
  if (motion() != CameraMotion::kResting) propagator_.learnVelocityBias(odometry, state_);
  propagator_.propagate(odometry, step, state_);
  if (step) watchdog_.step(step->jump_odom_m);
  if (!is_kept) state_.removeFrame(state_.frames().size() - 2);
  watchForContradiction();
  map_update_.beginFrame();
}

void Msckf::watchForContradiction() {
  Contradiction contradiction;
  contradiction.bias_sigmas = propagator_.biasSigmas(state_);
  // Landmarks and tracks of the last image: of this one nothing has been seen yet.
  contradiction.fix_nis = map_update_.comparedNis();
  contradiction.is_camera_confirmed = map_update_.isLocated();
  contradiction.tracks = {candidates(), used(), propagator_.travelled_m()};
  if (watchdog_.see(newest().stamp_ns, contradiction)) {
    // Nothing that the camera said counts any more. Landmarks keep their anchors: they may be
    // right, and show it later. Moves of the pose make it uncertain, there and back as well.
    tracks_ = TrackWindow(T_rig_cam_.linear(), config_.track_sigma_px, config_.track_scene_px);
    track_update_.forgetEarlierCamera();
    map_update_.reset();
    zero_motion_.reset();
    while (state_.frames().size() > 1) dropOldest();
    if (watchdog_.doubtsAll()) propagator_.returnTo(Eigen::Isometry3d::Identity(), state_);
    propagator_.returnTo(watchdog_.trustedT_map_odom(), state_);
  }
  watchdog_.keepWhileCalm(propagator_.T_map_odom(state_));
}

FixOutcome Msckf::fix(const std::vector<LandmarkObservation>& observations,
                      double focal_length_px) {
  if (!isDistrustful())
    return map_update_.apply(observations, T_rig_cam_.translation(), focal_length_px, propagator_,
                             state_);
  map_update_.skip(observations.size());
  return FixOutcome::kNone;
}

const std::vector<UsedTrack>& Msckf::track(const ImageFeatures& features, FrameBudget& budget) {
  track_update_.skip();
  order_.reset(features);
  useStillness(features);
  height_.apply(state_);
  if (!isDistrustful() && needsKeyframe(features) && budget.take(OptionalWork::kKeyframe))
    useTracks(features);
  if (static_cast<int>(features.tracked()) < kFewestFeatures) {
    anchors_.breakOff();
    if (anchors_.current() == 0 && !state_.anchors().empty() && !config_.localise_only)
      map_update_.blindStretch().note(newest().stamp_ns);
  }
  return track_update_.used();
}

void Msckf::useTracks(const ImageFeatures& features) {
  zero_motion_.noteKeyframe(newest().id);
  tracks_.add(newest().id, features, order_);
  anchors_.choose(state_, track_update_.pointDistance_m());
  const int others = zero_motion_.keepsExtraFrame(state_) ? 1 : 0;
  const bool is_full = static_cast<int>(state_.frames().size()) - others > config_.max_clones;
  track_update_.apply(tracks_.takeFinished(state_.frames(), is_full), T_rig_cam_.translation(),
                      features.focal_length_px, anchors_.current(), tracks_, state_);
  if (!track_update_.used().empty() && !config_.localise_only) anchors_.use();
  if (is_full) dropOldest();
}

void Msckf::useStillness(const ImageFeatures& features) {
  if (isDistrustful()) {
    zero_motion_.skip();
    return;
  }
  const bool is_located = map_update_.isLocated();
  zero_motion_.apply(features, T_rig_cam_, propagator_.T_odom_base(), is_located, state_);
  if (is_located || motion() == CameraMotion::kResting) return;
  limitByScene(features, order_, T_rig_cam_.translation(), zero_motion_.sceneDepth(), tracks_,
               state_);
}

bool Msckf::needsKeyframe(const ImageFeatures& features) {
  const auto keyframe = indexOf(state_.frames(), tracks_.keyframeId());
  if (!keyframe) return true;
  if (motion() == CameraMotion::kResting) return false;
  const Clone& last = state_.frames()[*keyframe];
  if (motion() != CameraMotion::kRotating &&
      seconds(newest().stamp_ns - last.stamp_ns) > kKeyframe_s)
    return true;
  const TrackWindow::Motion moved = tracks_.motionSince(last, newest(), features, order_);
  return moved.lost > moved.common || moved.common == 0 ||
         moved.median_px > kKeyframeSigmas * config_.track_sigma_px;
}

void Msckf::dropOldest() {
  const auto& frames = state_.frames();
  const std::size_t oldest = zero_motion_.isReferenceOnly(frames.front().id) ? 1 : 0;
  tracks_.dropFrame(frames[oldest].id);
  anchors_.retire(oldest, state_);
}

}  // namespace ardrone_vslam
