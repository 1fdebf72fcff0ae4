// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/slam.hpp"

#include <cassert>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "config/slam_config_faults.hpp"
#include "pipeline/slam_state.hpp"

namespace ardrone_vslam {
namespace {

void refuseExtrinsics(const Eigen::Isometry3d& T_base_cam) {
  const std::string fault = extrinsicsFault(T_base_cam);
  if (!fault.empty()) throw std::invalid_argument("the camera's mounting: " + fault);
}

}  // namespace

bool isFinite(const FrameResult& r) {
  return r.T_map_base.matrix().allFinite() && r.T_odom_base.matrix().allFinite() &&
         (r.T_map_base.translation() - r.T_odom_base.translation()).allFinite() &&
         r.covariance.allFinite() && std::isfinite(r.sigma_m);
}

std::string extrinsicsFault(const Eigen::Isometry3d& T_base_cam) {
  if (!T_base_cam.matrix().allFinite())
    return "it is not finite; correct the transform from base to camera";
  const double farthest_m = T_base_cam.translation().cwiseAbs().maxCoeff();
  if (farthest_m <= kFarthestCamera_m) return {};
  std::ostringstream fault;
  fault << "the camera is " << farthest_m << " m from base, beyond " << kFarthestCamera_m
        << " m; correct the transform (metres are asked for)";
  return fault.str();
}

Slam::Slam(const SlamConfig& config, const Eigen::Isometry3d& T_base_cam) {
  validate(config);
  const std::vector<std::string> faults = faultsBetween(config);
  if (!faults.empty()) throw ConfigError(faults);
  refuseExtrinsics(T_base_cam);
  state_ = std::make_unique<State>(config, T_base_cam);
}

Slam::~Slam() = default;

bool Slam::canChangeCamera() const {
  return !state_->constraint || state_->config.msckf.odometry.extrinsics_sigma_deg == 0;
}

void Slam::changeCamera(const Eigen::Isometry3d& T_base_cam) {
  assert(canChangeCamera() && "an estimated mounting error is one camera's");
  refuseExtrinsics(T_base_cam);
  state_->T_base_cam = T_base_cam;
  state_->view.changeCamera();
  if (state_->constraint) state_->constraint->changeCamera(T_base_cam);
}

const std::vector<Landmark>& Slam::landmarks() const {
  return state_->landmark_map.all();
}

void Slam::reserveMap() {
  constexpr std::size_t kOfOneImage = 500;
  const auto most = static_cast<std::size_t>(state_->config.landmark_map.max_landmarks);
  state_->landmark_map.reserve(most + kOfOneImage);
}

Eigen::Isometry3d Slam::T_map_odom() const {
  if (state_->constraint) return state_->result.T_map_base * state_->result.T_odom_base.inverse();
  // Both poses have the odometry's orientation, so that only the positions differ; this form stays
  // exact far from the origin.
  Eigen::Isometry3d T_map_odom = Eigen::Isometry3d::Identity();
  T_map_odom.translation() =
      state_->result.T_map_base.translation() - state_->result.T_odom_base.translation();
  return T_map_odom;
}

const FrameResult& Slam::process(const ImageFeatures& features, const OdometryState& odometry,
                                 const StageHook& hook) {
  State& s = *state_;
  assert(odometry.stamp_ns == features.stamp_ns &&
         "the odometry state must be for the image's stamp");
  assert((!s.started || features.stamp_ns > s.result.stamp_ns) && "stamps must ascend");
  const auto enter = [&hook](Stage stage) {
    if (hook) hook(stage);
  };
  s.result = {};
  s.result.features = static_cast<int>(features.size());

  enter(Stage::kLocalise);
  s.predict(features, odometry);
  if (!s.poseAt(odometry).matrix().allFinite() || !s.covariance().allFinite()) {
    s.landmark_matches = {};
    s.feature_matches = {};
    s.report(odometry);  // which says so; nothing of it may reach the map
    enter(Stage::kIdle);
    return s.result;
  }
  if (s.config.estimator == Estimator::kOdometry) {
    s.result.state = SlamState::kOdometryOnly;
  } else {
    enter(Stage::kAssociate);
    s.associator.matchLandmarks(s.view, s.landmark_map, s.landmark_matches);
    enter(Stage::kLocalise);
    s.constraint ? s.fixByLandmarks() : s.localise();
    enter(Stage::kMap);
    s.constraint ? s.useTracks(features) : s.refineAndMap();
  }
  s.report(odometry);
  enter(Stage::kIdle);
  return s.result;
}

Eigen::Isometry3d Slam::State::poseAt(const OdometryState& odometry) const {
  Eigen::Isometry3d T_map_base = odometry.T_odom_base;  // orientation: the odometry's, drift-free
  if (constraint) {
    T_map_base = constraint->T_map_base();
  } else {
    T_map_base.translation() = filter.position_map();
  }
  return T_map_base;
}

Matrix6d Slam::State::covariance() const {
  if (constraint) return constraint->covariance();
  const double attitude_rad = config.thesis_filter.attitude_sigma_deg * M_PI / 180;
  Matrix6d covariance = Matrix6d::Zero();
  covariance.topLeftCorner<3, 3>() = filter.covariance();
  covariance.bottomRightCorner<3, 3>() = attitude_rad * attitude_rad * Eigen::Matrix3d::Identity();
  return covariance;
}

void Slam::State::predict(const ImageFeatures& features, const OdometryState& odometry) {
  const auto step = step_watch.see(odometry);
  if (step) result.odometry_step_m = step->step_odom_m.norm();
  if (constraint) {
    passGap(odometry.stamp_ns);
    started ? constraint->predict(odometry, step) : constraint->start(odometry);
  } else if (started) {
    filter.predict(odometry);
  } else {
    filter.start(odometry.T_odom_base.translation(), odometry);
  }
  started = true;  // where map equalled odom
  const Eigen::Isometry3d T_map_base = poseAt(odometry);
  offset_map = T_map_base.linear() * T_base_cam.translation();
  Eigen::Isometry3d T_map_cam = T_map_base * T_base_cam;
  if (constraint) T_map_cam.linear() = constraint->newest().R_map_rig * T_base_cam.linear();
  if (config.planar) {
    T_map_cam.translation().z() = 0;
    offset_map.z() = 0;
  }
  view.reset(features, T_map_cam, config.planar);
  setVariance();
}

void Slam::State::setVariance() {
  view.setPositionVariance(covariance().topLeftCorner<3, 3>().trace() / 3,
                           constraint || config.thesis_filter.common_drift);
  if (constraint) setDrifts();
}

std::optional<PositionFix> Slam::State::locate(const std::vector<Association>& matches) {
  observations.clear();
  for (const Association& match : matches) {
    const Landmark& landmark = landmark_map.all()[static_cast<std::size_t>(match.target)];
    observations.push_back({landmark.position_map,
                            view.ray(static_cast<std::size_t>(match.feature)).direction_map,
                            landmark.sigma_m, landmark.position_variance_m2});
  }
  auto fix =
      filter.locate(observations, view.origin_map(), mapper.angleSigma_rad(view.focalLength_px()));
  if (!fix) return std::nullopt;
  fix->position_map -= offset_map;  // of the base
  if (config.planar) fix->position_map.z() = filter.position_map().z();
  result.camera_position_map = fix->position_map;
  result.camera_sigma_m = std::sqrt(fix->covariance.trace() / 3);
  return fix;
}

void Slam::State::localise() {
  const auto fix = locate(landmark_matches.matches);
  if (!fix) {
    result.state = landmark_map.size() == 0 ? SlamState::kBuildingMap : SlamState::kTooFewLandmarks;
    return;
  }
  result.state = filter.fuse(*fix) ? SlamState::kLocalised : SlamState::kFixRejected;
}

void Slam::State::refineAndMap() {
  Eigen::Vector3d camera_map = filter.position_map() + offset_map;
  if (config.planar) camera_map.z() = 0;
  view.setOrigin(camera_map);
  setVariance();
  used.assign(view.size(), false);
  for (const Association& match : landmark_matches.matches)
    used[static_cast<std::size_t>(match.feature)] = true;
  mapper.refine(view, landmark_matches.matches, landmark_map);
  // An image that shows nothing (dark, lens covered) says nothing about the landmarks either.
  if (view.size() > 0)
    result.removed_landmarks = mapper.countMissed(landmark_matches.missed, landmark_map);

  associator.matchMapFeatures(view, feature_map, used, feature_matches);
  result.new_landmarks =
      mapper.triangulateMatches(view, feature_matches.matches, feature_map, landmark_map, used);
  mapper.storeRest(view, used, feature_map);
  feature_map.compact(view.features().stamp_ns);
  result.removed_landmarks += landmark_map.enforceCap();
}

void Slam::State::report(const OdometryState& odometry) {
  result.stamp_ns = odometry.stamp_ns;
  result.T_odom_base = odometry.T_odom_base;
  result.T_map_base = poseAt(odometry);
  result.covariance = covariance();
  result.sigma_m = std::sqrt(result.covariance.topLeftCorner<3, 3>().trace() / 3);
  if (config.estimator != Estimator::kOdometry) {
    result.match_method = landmark_matches.method;
    result.landmarks_in_view = landmark_matches.in_view;
    result.landmark_candidates = landmark_matches.candidates;
    result.landmark_matches = static_cast<int>(landmark_matches.matches.size());
    result.feature_candidates = constraint ? constraint->candidates() : feature_matches.candidates;
    result.feature_matches =
        constraint ? constraint->used() : static_cast<int>(feature_matches.matches.size());
  }
  result.landmarks = static_cast<int>(landmark_map.size());
  result.map_features = static_cast<int>(feature_map.size());
  if (constraint) {
    result.fix_nis = constraint->fixNis();
    result.scale_error = constraint->scaleError();
    result.scale_sigma = constraint->scaleSigma();
    result.height = constraint->heightOutcome();
  }
  if (!isFinite(result)) result.state = SlamState::kNotFinite;
}

const char* explain(SlamState state) {
  switch (state) {
    case SlamState::kBuildingMap:
      return "no landmark yet: they appear when the camera has moved sideways by a few hundredths "
             "of the distance to what it sees";
    case SlamState::kLocalised:
      return "";
    case SlamState::kTooFewLandmarks:
      return "fewer landmarks recognised than min_landmarks: the view is new, blurred, dark or "
             "plain; the pose follows the odometry";
    case SlamState::kFixRejected:
      return "the landmarks' position disagrees with the odometry by more than gate_sigmas "
             "(MSCKF: fix_gate_sigmas); the pose follows the odometry";
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
      return "a place seen before was found again after the pose had become uncertain; the pose "
             "may have jumped there";
    case SlamState::kDistrusted:
      return "camera and odometry contradict each other by far more than configured "
             "(watchdog_sigmas, watchdog_nis), so the pose follows the odometry for "
             "watchdog_pause_s: check calibration and mounting, whether the scene itself moves, "
             "and "
             "velocity_bias_m_s";
    case SlamState::kNotFinite:
      return "the pose is not finite and is not published; the map begins anew: check odometry, "
             "calibration and mounting for absurd values";
  }
  return "";
}

}  // namespace ardrone_vslam
