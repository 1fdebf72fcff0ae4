// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/slam.hpp"

#include <cassert>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "association/associator.hpp"
#include "config/slam_config_faults.hpp"
#include "map/landmark_map.hpp"
#include "matching/frame_view.hpp"
#include "odometry/odometry_step.hpp"
#include "pipeline/make_estimator.hpp"

namespace ardrone_vslam {
namespace {

bool isFinite(const Estimate& estimate) {
  return estimate.T_map_base.matrix().allFinite() && estimate.covariance.allFinite();
}

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
  return result;
}

void noteMatches(const AssociationResult& matches, FrameResult& result) {
  result.match_method = matches.method;
  result.landmarks_in_view = matches.in_view;
  result.landmark_candidates = matches.candidates;
  result.landmark_matches = static_cast<int>(matches.matches.size());
}

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

struct Slam::State {
  State(const SlamConfig& c, const Eigen::Isometry3d& T_base_cam)
      : config(c),
        estimator(makeEstimator(c, T_base_cam)),
        associator(c.association),
        map(c.landmark_map) {}

  SlamConfig config;
  OdometryStepWatch step_watch;
  std::unique_ptr<Estimator> estimator;
  FrameView view;
  Associator associator;
  AssociationResult matches;
  LandmarkMap map;
  FrameResult result;
  Eigen::Isometry3d T_map_odom = Eigen::Isometry3d::Identity();
};

Slam::Slam(const SlamConfig& config, const Eigen::Isometry3d& T_base_cam) {
  validate(config);
  const std::vector<std::string> faults = faultsBetween(config);
  if (!faults.empty()) throw ConfigError(faults);
  refuseExtrinsics(T_base_cam);
  SlamConfig used = config;
  if (used.thesis_filter.as_printed) used.thesis_filter = asPrinted(used.thesis_filter);
  state_ = std::make_unique<State>(used, T_base_cam);
}

Slam::~Slam() = default;

void Slam::heed(const SetupFinding& finding) {
  state_->estimator->heed(finding);
}

bool Slam::canChangeCamera() const {
  return state_->estimator->canChangeCamera();
}

void Slam::changeCamera(const Eigen::Isometry3d& T_base_cam) {
  assert(canChangeCamera() && "an estimated error of the extrinsics is one camera's");
  refuseExtrinsics(T_base_cam);
  state_->view.changeCamera();
  state_->estimator->changeCamera(T_base_cam);
}

const std::vector<Landmark>& Slam::landmarks() const {
  return state_->map.all();
}

void Slam::reserveMap() {
  constexpr std::size_t kOfOneImage = 500;
  const auto most = static_cast<std::size_t>(state_->config.landmark_map.max_landmarks);
  state_->map.reserve(most + kOfOneImage);
}

Eigen::Isometry3d Slam::T_map_odom() const {
  return state_->T_map_odom;
}

const FrameResult& Slam::process(const ImageFeatures& features, const OdometryState& odometry,
                                 const StageHook& hook) {
  State& s = *state_;
  assert(odometry.stamp_ns == features.stamp_ns &&
         "the odometry must be that of the image's stamp");
  assert((s.result.stamp_ns == 0 || features.stamp_ns > s.result.stamp_ns) && "stamps must ascend");
  const auto enter = [&hook](Stage stage) {
    if (hook) hook(stage);
  };
  Estimator& estimator = *s.estimator;
  Correction correction;
  MapChanges changes;

  enter(Stage::kLocalise);
  const std::optional<OdometryStep> step = s.step_watch.see(odometry);
  estimator.predict(odometry, step);
  CameraPose camera = estimator.camera();
  s.view.reset(features, camera.T_map_cam, s.config.planar);
  moveTo(std::move(camera), s.view);
  s.matches = {};
  // Of what is not finite nothing may reach the map; the result says so.
  if (isFinite(estimator.estimate())) {
    enter(Stage::kAssociate);
    if (estimator.wantsLandmarks()) s.associator.matchLandmarks(s.view, s.map, s.matches);
    enter(Stage::kLocalise);
    correction = estimator.correct(s.matches, s.view, s.map);
    enter(Stage::kMap);
    changes = estimator.updateMap(s.matches, s.view, s.map);
    changes.removed_landmarks += s.map.enforceCap();
  }

  const Estimate estimate = estimator.estimate();
  s.T_map_odom = estimate.T_map_odom;
  s.result = resultOf(estimate, correction, changes);
  s.result.stamp_ns = odometry.stamp_ns;
  s.result.T_odom_base = odometry.T_odom_base;
  if (step) s.result.odometry_step_m = step->jump_odom_m.norm();
  s.result.features = static_cast<int>(features.size());
  s.result.landmarks = static_cast<int>(s.map.size());
  noteMatches(s.matches, s.result);
  if (!isFinite(s.result)) s.result.state = SlamState::kNotFinite;
  enter(Stage::kIdle);
  return s.result;
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
      return "a place seen before was found again after the pose had become uncertain; the pose "
             "may have jumped there";
    case SlamState::kDistrusted:
      return "camera and odometry contradict each other by far more than configured, so the "
             "pose follows the odometry for 10 s, each time twice as long: check calibration and "
             "mounting, whether the scene itself moves, and velocity_bias_m_s";
    case SlamState::kNotFinite:
      return "the pose is not finite and is not published; the map begins anew: check odometry, "
             "calibration and mounting for absurd values";
  }
  return "";
}

}  // namespace ardrone_vslam
