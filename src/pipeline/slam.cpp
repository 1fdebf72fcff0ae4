// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/slam.hpp"

#include <cassert>
#include <stdexcept>
#include <utility>

#include "association/associator.hpp"
#include "config/slam_config_faults.hpp"
#include "map/landmark_map.hpp"
#include "map_search/map_search.hpp"
#include "matching/frame_view.hpp"
#include "odometry/odometry_step.hpp"
#include "pipeline/frame_results.hpp"
#include "pipeline/make_estimator.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kDoubt = 0.5;  // sigma of a doubtful way, of its length

bool isFinite(const Estimate& estimate) {
  return estimate.T_map_base.matrix().allFinite() && estimate.covariance.allFinite();
}

void refuseExtrinsics(const Eigen::Isometry3d& T_base_cam) {
  const std::string fault = extrinsicsFault(T_base_cam);
  if (!fault.empty()) throw std::invalid_argument("the camera's mounting: " + fault);
}

void refuseMaps(const SlamConfig& config) {
  const std::string fault = faultOfMaps(config);
  if (!fault.empty()) throw std::invalid_argument(fault);
}

}  // namespace

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
  std::unique_ptr<MapSearch> search;  // until the flight has been found
  MapCamera seen_by;                  // the last frame
  /// The thesis's 2-D mode; the MSCKF's `planar` is a measurement of z.
  bool hasFlatRays() const { return config.planar && config.estimator != EstimatorKind::kMsckf; }
  FrameResult result;
  Eigen::Isometry3d T_map_odom = Eigen::Isometry3d::Identity();

  /// Where the flight is in a loaded map; once that is known, the frame goes on there.
  void searchMap(const ImageFeatures& features, CameraPose& camera) {
    if (!isFinite(estimator->estimate())) return;
    const auto entry = search->see(features, camera.T_map_cam);
    if (!entry) return;
    estimator->enterMap(*entry, search->map(), view, map);
    search.reset();
    camera = estimator->camera();
    view.reset(features, camera.T_map_cam, hasFlatRays());
  }
};

Slam::Slam(const SlamConfig& config, const Eigen::Isometry3d& T_base_cam) {
  validate(config);
  if (const auto faults = faultsBetween(config); !faults.empty()) throw ConfigError(faults);
  refuseExtrinsics(T_base_cam);
  state_ = std::make_unique<State>(config, T_base_cam);
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

void Slam::load(SavedMap map) {
  assert(state_->result.stamp_ns == 0 && "a map is loaded before the first frame");
  refuseMaps(state_->config);
  state_->search = std::make_unique<MapSearch>(std::move(map), state_->config);
}

bool Slam::isSearching() const {
  return state_->search != nullptr;
}

SavedMap Slam::save() const {
  refuseMaps(state_->config);
  SavedMap map = state_->estimator->save(state_->map);
  map.camera = state_->seen_by;
  return map;
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
  s.view.reset(features, camera.T_map_cam, s.hasFlatRays());
  s.seen_by = {features.width_px, features.height_px, features.focal_length_px};
  if (s.search) {
    enter(Stage::kAssociate);
    s.searchMap(features, camera);
    enter(Stage::kLocalise);
  }
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
  const double lost_m = s.step_watch.frozenWay_m() + kDoubt * estimate.doubtful_way_m;
  if (lost_m > 0) widenPlace(s.result, lost_m);
  noteFeatures(features, s.result);
  s.result.landmarks = static_cast<int>(s.map.size());
  noteMatches(s.matches, s.result);
  if (s.search) {
    s.result.state = SlamState::kSearchingMap;
    forgetPlace(s.result);
  }
  if (!isFinite(s.result)) s.result.state = SlamState::kNotFinite;
  enter(Stage::kIdle);
  return s.result;
}

}  // namespace ardrone_vslam
