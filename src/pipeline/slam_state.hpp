// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

#include "ardrone_vslam/slam.hpp"
#include "map/mapper.hpp"
#include "map_update/time_since_fix.hpp"
#include "matching/association.hpp"
#include "matching/frame_view.hpp"
#include "msckf/msckf.hpp"
#include "odometry/odometry_step.hpp"
#include "thesis/thesis_filter.hpp"

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
    if (c.estimator == Estimator::kMsckf) constraint.emplace(c.msckf, T_base_cam);
  }

  SlamConfig config;
  Eigen::Isometry3d T_base_cam;
  Associator associator;
  ThesisFilter filter;
  std::optional<Msckf> constraint;  // instead of the filter above
  Mapper mapper;
  FeatureMap feature_map;
  LandmarkMap landmark_map;

  bool started = false;
  Eigen::Vector3d offset_map = Eigen::Vector3d::Zero();  // base -> camera, at the present attitude
  FrameView view;
  AssociationResult landmark_matches;
  AssociationResult feature_matches;
  std::vector<Association> trusted_matches;   // MSCKF: of landmark_matches
  TimeSinceFix time_since_fix;                // MSCKF
  std::optional<std::int64_t> last_stamp_ns;  // MSCKF
  double unclocked_s = 0;                     // since then, and not yet on time_since_fix
  OdometryStepWatch step_watch;
  std::vector<Observation> observations;
  std::vector<bool> used;  // the frame's features that need not be stored
  FrameResult result;

  void predict(const ImageFeatures& features, const OdometryState& odometry);
  void setVariance();
  void setDrifts();  // MSCKF
  /// Pose of base by the filter in use.
  Eigen::Isometry3d poseAt(const OdometryState& odometry) const;
  Matrix6d covariance() const;
  /// Base by the landmarks alone, without prediction.
  std::optional<PositionFix> locate(const std::vector<Association>& matches);
  void localise();
  void refineAndMap();
  void report(const OdometryState& odometry);

  // The same two steps by the MSCKF (slam_msckf.cpp).
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
