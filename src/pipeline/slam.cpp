// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/slam.hpp"

#include <cassert>
#include <stdexcept>
#include <utility>

#include "config/slam_config_faults.hpp"
#include "pipeline/frame_results.hpp"
#include "pipeline/slam_state.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kDoubt = 0.5;  // sigma of a doubtful way, of its length

void refuse(const std::string& fault, const char* what = "") {
  if (!fault.empty()) throw std::invalid_argument(what + fault);
}

}  // namespace

Slam::Slam(const SlamConfig& config, const Eigen::Isometry3d& T_base_cam) {
  validate(config);
  if (const auto faults = faultsBetween(config); !faults.empty()) throw ConfigError(faults);
  refuse(extrinsicsFault(T_base_cam), "the camera's mounting: ");
  state_ = std::make_unique<State>(config, T_base_cam);
}

Slam::~Slam() = default;

void Slam::heed(const SetupFinding& finding) {
  state_->estimator->heed(finding);
}

void Slam::changeCamera(const Eigen::Isometry3d& T_base_cam) {
  refuse(extrinsicsFault(T_base_cam), "the camera's mounting: ");
  state_->view.changeCamera();
  state_->cameras.T_base_cam = T_base_cam;
  state_->revisits.changeCamera();
  state_->estimator->changeCamera(T_base_cam);
}

void Slam::load(SavedMap map) {
  assert(state_->result.stamp_ns == 0 && "a map is loaded before the first frame");
  refuse(faultOfMaps(state_->config, map.landmarks.size()));
  state_->search = std::make_unique<MapSearch>(std::move(map), state_->config);
}

void Slam::lookNear(const PlaceHint& hint) {
  refuse(faultOfMaps(state_->config));
  if (!isSearching() && landmarks().size() < kFewestFixLandmarks)
    throw std::invalid_argument("there is no map yet to look in: fly first");
  if (!isSearching()) state_ = state_->flyAgain();
  state_->search->lookNear(hint);
}

bool Slam::isSearching() const {
  return state_->search != nullptr;
}

bool Slam::hasWholeMap() const {
  return !isSearching() || state_->search->isOwn();
}

MapSnapshot Slam::save() const {
  refuse(faultOfMaps(state_->config));
  return isSearching() && hasWholeMap() ? MapSnapshot(state_->search->map()) : state_->save();
}

const Landmarks& Slam::landmarks() const {
  return state_->map.all();
}

void Slam::limit(const LandmarkMapConfig& landmark_map, const FrameBudgetConfig& frame_budget) {
  state_->map.limit(landmark_map);
  state_->config.landmark_map = landmark_map;
  state_->budget.limit(frame_budget.frame_budget_ms);
}

void Slam::reserveMap() {
  state_->map.reserve();
}

Eigen::Isometry3d Slam::T_map_odom() const {
  return state_->result.T_map_base * state_->result.T_odom_base.inverse();
}

const FrameResult& Slam::process(const ImageFeatures& features, const OdometryState& odometry,
                                 const StageHook& hook, const FrameClock& clock) {
  assert(odometry.stamp_ns == features.stamp_ns &&
         "the odometry must be that of the image's stamp");
  assert((state_->result.stamp_ns == 0 || features.stamp_ns > state_->result.stamp_ns) &&
         "stamps must ascend");
  const auto enter = [&hook](Stage stage) {
    if (hook) hook(stage);
  };
  enter(Stage::kLocalise);
  if (state_->isOver(odometry)) state_ = state_->flyAgain();
  State& s = *state_;
  s.budget.begin(clock);
  Estimator& estimator = *s.estimator;
  Correction correction;
  MapChanges changes;
  const std::optional<OdometryStep> step = s.step_watch.see(odometry);
  estimator.predict(odometry, step);
  CameraPose camera = estimator.camera();
  s.view.reset(features, camera.T_map_cam, s.hasFlatRays());
  enter(Stage::kAssociate);
  const double revisit_m = s.searchMap(features, camera);
  enter(Stage::kLocalise);
  moveTo(std::move(camera), s.view);
  s.matches.clear();
  // Of what is not finite nothing may reach the map; the result says so.
  if (isFinite(estimator.estimate())) {
    enter(Stage::kAssociate);
    s.matchLandmarks();
    enter(Stage::kLocalise);
    correction = estimator.correct(s.matches, s.view, s.map);
    s.noteLandmarks(correction);
    if (revisit_m > 0 && correction.state == SlamState::kLocalised)
      correction.state = SlamState::kRelocated;
    enter(Stage::kMap);
    changes = estimator.updateMap(s.matches, s.view, s.map, s.budget);
    changes.removed_landmarks += s.map.enforceCap();
    s.budget.done(OptionalWork::kKeyframe);
  }

  const Estimate estimate = estimator.estimate();
  s.result = resultOf(estimate, correction, changes);
  s.noteOdometry(odometry, step);
  s.result.revisit_m = revisit_m;
  const double lost_m = s.step_watch.frozenWay_m() + kDoubt * estimate.doubtful_way_m;
  if (lost_m > 0) widenPlace(s.result, lost_m);
  s.noteFeatures(features);
  if (s.search) {
    s.result.state = SlamState::kSearchingMap;
    forgetPlace(s.result);
  }
  if (!isFinite(s.result)) s.result.state = SlamState::kNotFinite;
  enter(Stage::kIdle);
  return s.result;
}

}  // namespace ardrone_vslam
