// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

#include "ardrone_vslam/association.hpp"
#include "ardrone_vslam/constraint_filter.hpp"
#include "ardrone_vslam/frame_view.hpp"
#include "ardrone_vslam/mapper.hpp"
#include "ardrone_vslam/odometry_step.hpp"
#include "ardrone_vslam/slam.hpp"
#include "ardrone_vslam/thesis_filter.hpp"
#include "blind_clock.hpp"

namespace ardrone_vslam {

struct Slam::State {
  State(const SlamConfig& c, const Eigen::Isometry3d& T_base_camera)
      : config(c),
        T_base_cam(T_base_camera),
        associator(c.association),
        filter(c.thesis_filter),
        mapper(c.mapper),
        feature_map(c.feature_map),
        landmark_map(c.landmark_map) {
    if (c.estimator == Estimator::kConstraint) constraint.emplace(c.constraint_filter, T_base_cam);
  }

  SlamConfig config;
  Eigen::Isometry3d T_base_cam;
  Associator associator;
  ThesisFilter filter;
  std::optional<ConstraintFilter> constraint;  // instead of the filter above
  Mapper mapper;
  FeatureMap feature_map;
  LandmarkMap landmark_map;

  bool started = false;
  Eigen::Vector3d offset_map = Eigen::Vector3d::Zero();  // base -> camera, at the present attitude
  FrameView view;
  AssociationResult landmark_matches;
  AssociationResult feature_matches;
  std::vector<Association> trusted_matches;   // constraint filter: of landmark_matches
  BlindClock blind_clock;                     // constraint filter
  std::optional<std::int64_t> last_stamp_ns;  // constraint filter
  double unclocked_s = 0;                     // since then, and not yet on blind_clock
  OdometryStepWatch step_watch;
  std::vector<Sighting> sightings;
  std::vector<bool> used;  // the frame's features that need not be stored
  FrameResult result;

  void predict(const ImageFeatures& features, const ObserverState& observer);
  void setVariance();
  void setDrifts();  // constraint filter
  /// Pose of base by the filter in use.
  Eigen::Isometry3d poseAt(const ObserverState& observer) const;
  Matrix6d covariance() const;
  /// Base by the landmarks alone, without prediction.
  std::optional<PositionFix> locate(const std::vector<Association>& matches);
  void localise();
  void refineAndMap();
  void report(const ObserverState& observer);

  // The same two steps by the constraint filter (slam_constraint.cpp).
  void passGap(std::int64_t stamp_ns);
  void fixByLandmarks();
  void useTracks(const ImageFeatures& features);
  void judgeMatches();
  int dropFailing();
  void moveLandmarks();
  bool isWellKnown(const UsedTrack& one) const;
  void renew(const UsedTrack& one, const Landmark& landmark);
};

}  // namespace ardrone_vslam
