// SPDX-License-Identifier: BSD-3-Clause
#include "msckf/msckf.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ardrone_vslam {
namespace {

double squared(double value) {
  return value * value;
}

std::optional<std::size_t> indexOf(const std::vector<Clone>& poses, std::uint32_t id) {
  const auto found =
      std::find_if(poses.begin(), poses.end(), [id](const Clone& pose) { return pose.id == id; });
  if (found == poses.end()) return std::nullopt;
  return static_cast<std::size_t>(found - poses.begin());
}

/// A track that passed its gate, and how far it is trusted.
struct Candidate {
  const FinishedTrack* track;
  TrackResidual constraint;
  double weight;
};

void sum(const std::vector<Candidate>& candidates, Information& information) {
  information.matrix.setZero();
  information.vector.setZero();
  for (const Candidate& c : candidates) {
    if (c.weight > 0) c.constraint.addTo(information, c.weight);
  }
  information.matrix.triangularView<Eigen::StrictlyUpper>() = information.matrix.transpose();
}

/// What calibration, rolling shutter and the scene do to the tracks of a keyframe they do to all
/// alike, so that it does not average out: n of them have the variance 1 / n + common.
/// @param common  variance of the error they share, over that of a ray
void limitByCommonError(double n, double common, Information& information) {
  const double share = 1 / (1 + n * common);
  information.matrix *= share;
  information.vector *= share;
}

/// Wrong tracks may pass a gate as wide as the prior, but they do not agree with the others: their
/// weight falls with what is left of their residual (Geman and McClure), at last to 0 or 1.
/// @return whether the information is that of the tracks that agree
bool agree(const WindowState& state, std::vector<Candidate>& candidates, Information& information) {
  constexpr int kRounds = 2;
  for (int round = 0; round < kRounds; ++round) {
    sum(candidates, information);
    const auto error = state.preview(information);
    if (!error) return false;
    for (Candidate& c : candidates) {
      const double left = c.constraint.squaredRest(*error, information.coordinates.front());
      const int dof = c.constraint.degreesOfFreedom();
      const bool is_last = round + 1 == kRounds;
      c.weight = is_last ? (left < chiSquare95(dof) ? 1 : 0) : 1 / squared(1 + left / dof);
    }
  }
  sum(candidates, information);
  return true;
}

}  // namespace

Msckf::Msckf(const MsckfConfig& config, const Eigen::Isometry3d& T_base_cam)
    : config_(config),
      camera_base_(T_base_cam.translation()),
      R_base_cam_(T_base_cam.linear()),
      state_(config.odometry, config.attitude_states),
      tracks_(T_base_cam.linear()),
      rest_(config.rest),
      height_(config.height),
      watchdog_(config.watchdog) {
  validate(config);
}

void Msckf::start(const OdometryState& odometry) {
  state_.start(odometry);
  height_ = HeightUpdate(config_.height);
  height_m_ = odometry.height_m;
}

void Msckf::changeCamera(const Eigen::Isometry3d& T_base_cam) {
  // With no keyframe since the last change the tracks are still those of the camera before.
  if (!earlier_camera_) earlier_camera_ = TrackCamera{camera_base_, sigma_a_};
  camera_base_ = T_base_cam.translation();
  R_base_cam_ = T_base_cam.linear();
  tracks_.changeCamera(R_base_cam_);
  forgetReference();
}

void Msckf::predict(const OdometryState& odometry, const std::optional<OdometryStep>& step) {
  const bool is_kept = newest_is_keyframe_ || newest().id == reference_id_;
  state_.propagate(odometry, step);
  if (step) trusted_T_map_odom_.translation() -= trusted_T_map_odom_.linear() * step->step_odom_m;
  if (!is_kept) state_.removeFrame(state_.frames().size() - 2);
  newest_is_keyframe_ = false;
  watchForContradiction();
  fix_outcome_ = FixOutcome::kNone;
  height_m_ = odometry.height_m;
}

std::optional<std::size_t> Msckf::frameOf(std::uint32_t id) const {
  return indexOf(state_.frames(), id);
}

std::optional<std::size_t> Msckf::anchorOf(std::uint32_t id) const {
  return indexOf(state_.anchors(), id);
}

Eigen::Isometry3d Msckf::T_map_base() const {
  Eigen::Isometry3d T_map_base = Eigen::Isometry3d::Identity();
  T_map_base.linear() = newest().R_map_rig * state_.R_base_rig().transpose();
  T_map_base.translation() = newest().position_map;
  return T_map_base;
}

Matrix6d Msckf::covariance() const {
  const auto P = state_.covariance();
  const int at = state_.frameCoordinate(state_.frames().size() - 1);
  constexpr int kExtrinsics = WindowState::kExtrinsics;
  const Eigen::Matrix3d R_map_base = T_map_base().linear();
  const Eigen::Matrix<double, 6, 3> shared =
      P.block<6, 3>(at, kExtrinsics) * R_map_base.transpose();
  Matrix6d covariance = P.block<6, 6>(at, at);
  covariance.rightCols<3>() -= shared;
  covariance.bottomRows<3>() -= shared.transpose();
  covariance.bottomRightCorner<3, 3>() +=
      R_map_base * P.block<3, 3>(kExtrinsics, kExtrinsics) * R_map_base.transpose();
  // The linear form takes the attitude as exact, but nobody else should.
  if (!config_.attitude_states) {
    const OdometryNoiseConfig& noise = config_.odometry;
    covariance.diagonal().tail<3>().array() +=
        (squared(noise.attitude_noise_deg) + squared(noise.tilt_sigma_deg)) * squared(M_PI / 180);
  }
  return 0.5 * (covariance + covariance.transpose());  // to the bit, whatever rounding did
}

double Msckf::scaleSigma() const {
  return std::sqrt(state_.covariance()(WindowState::kScale, WindowState::kScale));
}

bool Msckf::isKeyframe(const ImageFeatures& features) {
  const auto keyframe = frameOf(keyframe_id_);
  if (!keyframe) return true;
  if (motion_ == CameraMotion::kResting) return false;
  const Clone& last = state_.frames()[*keyframe];
  if (motion_ != CameraMotion::kRotating &&
      static_cast<double>(newest().stamp_ns - last.stamp_ns) * 1e-9 > config_.keyframe_s)
    return true;
  const TrackWindow::Motion motion = tracks_.motionSince(last, newest(), features, order_);
  return motion.lost > motion.common || motion.common == 0 ||
         motion.median_px > config_.keyframe_px;
}

const std::vector<UsedTrack>& Msckf::track(const ImageFeatures& features) {
  used_.clear();
  candidates_ = 0;
  order_.reset(features);
  if (isDistrustful()) {
    motion_ = CameraMotion::kUnknown;
  } else {
    watchForRest(features);
    holdToScene(features);
  }
  height_outcome_ = height_m_ ? height_.apply(*height_m_, state_) : HeightOutcome::kNone;
  if (isDistrustful() || !isKeyframe(features)) return used_;
  newest_is_keyframe_ = true;
  keyframe_id_ = newest().id;
  if (reference_id_ == keyframe_id_) reference_is_keyframe_ = true;
  tracks_.add(newest().id, features, order_);
  chooseAnchor();
  sigma_a_ = config_.track_sigma_px / features.focal_length_px;
  const int others = reference_is_keyframe_ || !frameOf(reference_id_) ? 0 : 1;
  const bool is_full = static_cast<int>(state_.frames().size()) - others > config_.window_frames;
  useTracks(tracks_.takeFinished(state_.frames(), is_full),
            earlier_camera_.value_or(TrackCamera{camera_base_, sigma_a_}));
  if (earlier_camera_) {  // all its tracks have ended, and this one sees something else
    earlier_camera_.reset();
    point_distance_m_ = 0;
  }
  if (is_full) dropOldest();
  return used_;
}

bool Msckf::hasKnownBaseline(TrackViews views) const {
  const std::size_t first = views.front().frame;
  const std::size_t last = views.back().frame;
  const Eigen::Matrix3d relative =
      state_.relativeCovariance(state_.frameCoordinate(first), state_.frameCoordinate(last))
          .topLeftCorner<3, 3>();
  const Eigen::Vector3d baseline =
      state_.frames()[last].position_map - state_.frames()[first].position_map;
  const double length_m2 = baseline.squaredNorm();
  // Along it, it is a matter of scale, which does no harm.
  const double across_m2 = relative.trace() - baseline.dot(relative * baseline) / length_m2;
  return across_m2 < squared(config_.baseline_uncertainty) * length_m2;
}

double Msckf::stretchSigma(TrackViews views, const Eigen::Vector3d& camera_base) const {
  const Clone& first = state_.frames()[views.front().frame];
  const Clone& last = state_.frames()[views.back().frame];
  const Eigen::Vector3d baseline = last.position_map + last.R_map_rig * camera_base -
                                   first.position_map - first.R_map_rig * camera_base;
  const double length_m = baseline.norm();
  const Eigen::Vector3d along_base = last.R_map_rig.transpose() * baseline / length_m;
  constexpr int kBias = WindowState::kBias;
  const double variance =
      along_base.dot(state_.covariance().block<3, 3>(kBias, kBias) * along_base);
  const double time_s = static_cast<double>(last.stamp_ns - first.stamp_ns) * 1e-9;
  return std::sqrt(variance) * time_s / length_m;
}

std::optional<FloorHeight> Msckf::floorOf(TrackViews views) const {
  if (!config_.height.floor_points) return std::nullopt;
  constexpr double kDown = 0.7;  // cosine: 45 degrees
  const Clone& frame = state_.frames()[views.back().frame];
  const double down = -(frame.R_map_rig * views.back().bearing_base).z();
  if (!frame.height_m || down < kDown) return std::nullopt;
  return FloorHeight{*frame.height_m, config_.height.floor_point_sigma_m};
}

void Msckf::useTracks(const std::vector<FinishedTrack>& finished, const TrackCamera& camera) {
  std::vector<Candidate> candidates;
  for (const FinishedTrack& track : finished) {
    if (static_cast<int>(track.views.size()) < config_.min_track_views ||
        !hasKnownBaseline(track.views))
      continue;
    const auto point =
        triangulateTrack(state_.frames(), camera.camera_base, track.views, camera.sigma_a);
    if (!point || point->parallax_rad < config_.track_parallax_sigmas * camera.sigma_a) continue;
    auto constraint = residualOf(state_, camera.camera_base, track.views, *point, camera.sigma_a);
    if (!constraint) continue;
    ++candidates_;
    double distance = constraint->distance(state_);
    int dof = constraint->degreesOfFreedom();
    if (!(distance < 2 * chiSquare95(dof))) continue;
    if (const auto floor = floorOf(track.views)) {
      auto on_floor =
          residualOf(state_, camera.camera_base, track.views, *point, camera.sigma_a, floor);
      const double with_floor = on_floor->distance(state_);
      // Else it is on a table, or the height is that of one.
      if (with_floor - distance < chiSquare95(1)) {
        *constraint = *std::move(on_floor);
        distance = with_floor;
        dof = constraint->degreesOfFreedom();
      }
    }
    candidates.push_back({&track, std::move(*constraint), 1 / squared(1 + distance / dof)});
  }
  if (candidates.empty()) return;

  const int first = state_.frameCoordinate(0);
  std::vector<int> coordinates(
      static_cast<std::size_t>(state_.frameCoordinate(state_.frames().size()) - first));
  std::iota(coordinates.begin(), coordinates.end(), first);
  Information information(std::move(coordinates));
  if (!agree(state_, candidates, information)) return;
  const auto n = std::count_if(candidates.begin(), candidates.end(),
                               [](const Candidate& c) { return c.weight > 0; });
  limitByCommonError(static_cast<double>(n),
                     squared(config_.track_common_px / config_.track_sigma_px), information);
  if (!state_.update(information)) return;

  std::vector<double> distances_m;
  for (const Candidate& c : candidates) {
    if (c.weight == 0) continue;
    tracks_.keepNewestView(c.track->track_id);
    const auto point =
        triangulateTrack(state_.frames(), camera.camera_base, c.track->views, camera.sigma_a);
    if (!point) continue;
    const Eigen::Matrix3d by_frames = covarianceByFrames(state_, camera.camera_base, c.track->views,
                                                         point->position_map, *frameOf(anchor_id_));
    used_.push_back({*c.track, *point, anchor_id_, point->covariance_m2 + by_frames,
                     stretchSigma(c.track->views, camera.camera_base)});
    distances_m.push_back((point->position_map - newest().position_map).norm());
  }
  if (used_.empty()) return;
  anchors_in_use_.insert(anchor_id_);
  const auto middle = distances_m.begin() + static_cast<std::ptrdiff_t>(distances_m.size() / 2);
  std::nth_element(distances_m.begin(), middle, distances_m.end());
  point_distance_m_ = *middle;
}

}  // namespace ardrone_vslam
