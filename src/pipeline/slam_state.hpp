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

/// What Slam keeps from one image to the next.
struct Slam::State {
  State(const SlamConfig& c, const Eigen::Isometry3d& T)
      : config(c),
        T_base_cam(T),
        estimator(makeEstimator(c, T)),
        associator(c.association),
        map(c.landmark_map),
        revisits(c) {}

  SlamConfig config;
  Eigen::Isometry3d T_base_cam;
  OdometryStepWatch step_watch;
  std::unique_ptr<Estimator> estimator;
  FrameView view;
  Associator associator;
  AssociationResult matches;
  LandmarkMap map;
  std::unique_ptr<MapSearch> search;  // until the flight has been found
  RevisitSearch revisits;             // from then on
  MapCamera seen_by;                  // the last frame
  /// The thesis's 2-D mode; the MSCKF's `planar` is a measurement of z.
  bool hasFlatRays() const { return config.planar && config.estimator != EstimatorKind::kMsckf; }
  FrameResult result;
  MapSnapshot save() const {
    MapSnapshot saved = estimator->save(map);
    saved.all_but_landmarks.camera = seen_by;
    return saved;
  }
  /// Another flight in the map so far, if there is one: where the drone is now is not known.
  std::unique_ptr<State> flyAgain() const {
    auto next = std::make_unique<State>(config, T_base_cam);
    const bool is_own = !search || search->isOwn();
    SavedMap so_far = search ? search->map() : save().map();
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
      auto entry = search->see(features, camera.T_map_cam, T_base_cam);
      if (!entry) return 0;
      estimator->enterMap(std::move(*entry), search->takeMap(), view, map);
      search.reset();
    } else {
      const bool is_trusted = result.state != SlamState::kDistrusted;
      const auto revisit = revisits.see(features, is_trusted, camera.T_map_cam, map);
      if (!revisit || !estimator->shift(*revisit, view, map)) return 0;
      revisits.noteShift(features.stamp_ns, *revisit);
      revisit_m = (revisit->entry.camera_loaded - camera.T_map_cam.translation()).norm();
    }
    camera = estimator->camera();
    view.reset(features, camera.T_map_cam, hasFlatRays());
    return revisit_m;
  }
};

}  // namespace ardrone_vslam
