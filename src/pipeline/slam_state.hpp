// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <utility>

#include "ardrone_vslam/slam.hpp"
#include "association/associator.hpp"
#include "map/landmark_map.hpp"
#include "map_search/map_search.hpp"
#include "map_search/revisit_search.hpp"
#include "map_update/map_fix.hpp"
#include "matching/frame_view.hpp"
#include "odometry/odometry_step.hpp"
#include "pipeline/frame_results.hpp"
#include "pipeline/make_estimator.hpp"

namespace ardrone_vslam {

/// The camera in use, and all that have seen the map.
struct Cameras {
  Eigen::Isometry3d T_base_cam;
  std::vector<MapCamera> of_map;
};

/// What Slam keeps from one image to the next.
struct Slam::State {
  State(const SlamConfig& c, const Eigen::Isometry3d& T)
      : config(c),
        cameras{T, {}},
        estimator(makeEstimator(c, T)),
        associator(c.association),
        map(c.landmark_map),
        revisits(c),
        budget(c.frame_budget.frame_budget_ms) {}

  SlamConfig config;
  Cameras cameras;
  OdometryStepWatch step_watch;
  std::unique_ptr<Estimator> estimator;
  FrameView view;
  Associator associator;
  AssociationResult matches;
  LandmarkMap map;
  std::unique_ptr<MapSearch> search;  // until the flight has been found
  RevisitSearch revisits;             // from then on
  FrameBudget budget;
  /// The thesis's 2-D mode; the MSCKF's `planar` is a measurement of z.
  bool hasFlatRays() const { return config.planar && config.estimator != EstimatorKind::kMsckf; }
  FrameResult result;
  MapSnapshot save() const {
    MapSnapshot saved = estimator->save(map);
    saved.all_but_landmarks.cameras = cameras.of_map;
    return saved;
  }
  /// Whether the flight cannot go on from where it was.
  bool isOver(const OdometryState& odometry) const {
    const bool is_new_start =
        config.estimator == EstimatorKind::kMsckf && step_watch.isNewStart(odometry);
    return is_new_start || result.state == SlamState::kNotFinite;
  }
  /// Another flight in the map so far, if there is one: where the drone is now is not known.
  std::unique_ptr<State> flyAgain() const {
    auto next = std::make_unique<State>(config, cameras.T_base_cam);
    next->cameras = cameras;
    if (config.estimator != EstimatorKind::kMsckf) return next;
    const bool is_own = !search || search->isOwn();
    SavedMap so_far = search ? search->map() : save().map();
    if (!so_far.anchor_covariance.allFinite()) return next;
    if (!is_own || so_far.landmarks.size() >= kFewestFixLandmarks)
      next->search = std::make_unique<MapSearch>(std::move(so_far), config, is_own);
    return next;
  }
  /// Where the flight is in a loaded map, or elsewhere in its own; once that is known, the frame
  /// goes on there. @return FrameResult::revisit_m
  double searchMap(const ImageFeatures& features, CameraPose& camera) {
    if (config.estimator != EstimatorKind::kMsckf || !camera.T_map_cam.matrix().allFinite())
      return 0;
    double revisit_m = 0;
    if (search) {
      if (!isFinite(estimator->estimate())) return 0;
      auto entry = search->see(features, camera.T_map_cam, cameras.T_base_cam, budget);
      if (!entry) return 0;
      for (const MapCamera& one : search->map().cameras) addCamera(one, cameras.of_map);
      estimator->enterMap(std::move(*entry), search->takeMap(), view, map);
      search.reset();
    } else {
      const bool is_trusted = result.state != SlamState::kDistrusted;
      const auto revisit = revisits.see(features, is_trusted, camera.T_map_cam, map, budget);
      if (!revisit || !estimator->shift(*revisit, view, map)) return 0;
      revisits.noteShift(features.stamp_ns, *revisit);
      revisit_m = (revisit->entry.camera_loaded - camera.T_map_cam.translation()).norm();
    }
    camera = estimator->camera();
    view.reset(features, camera.T_map_cam, hasFlatRays());
    return revisit_m;
  }
  void matchLandmarks() {
    if (estimator->wantsLandmarks() && map.size() > 0 && budget.take(OptionalWork::kLandmarks))
      associator.matchLandmarks(view, map, matches);
  }
  /// After the correction by what matchLandmarks() has found.
  void noteLandmarks(const Correction& correction) {
    budget.done(OptionalWork::kLandmarks);
    // Landmarks that were not looked for say nothing.
    if (!budget.hasLeftOut(OptionalWork::kLandmarks)) revisits.know(correction.known_since_ns);
  }
  void noteOdometry(const OdometryState& odometry, const std::optional<OdometryStep>& step) {
    result.stamp_ns = odometry.stamp_ns;
    result.T_odom_base = odometry.T_odom_base;
    if (step) result.odometry_step_m = step->jump_odom_m.norm();
  }
  void noteFeatures(const ImageFeatures& features) {
    addCamera({features.width_px, features.height_px, features.focal_length_px}, cameras.of_map);
    ardrone_vslam::noteFeatures(features, result);
    noteMatches(matches, result);
    result.landmarks = static_cast<int>(map.size());
    result.left_out = budget.leftOut();
  }
};

}  // namespace ardrone_vslam
