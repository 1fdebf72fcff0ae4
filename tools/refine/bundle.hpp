// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/ceres.h>

#include <Eigen/Geometry>
#include <functional>
#include <memory>
#include <vector>

#include "ardrone_vslam/flight_record.hpp"
#include "refine/bundle_odometry.hpp"
#include "refine/track_points.hpp"

namespace ardrone_vslam {

/// The least squares problem of a whole flight: poses of its keyframes, slow errors of its
/// odometry and of the cameras' extrinsics, heights of its floors, and the points that it saw.
class Bundle {
 public:
  /// @param record  must outlive this. @pre it has a keyframe
  explicit Bundle(const FlightRecord& record);

  /// Minimises, with views that are off by more than about `most_sigmas` counting ever less.
  /// @param step  called after each iteration. @throws std::runtime_error when it cannot be solved
  void solve(double most_sigmas, const std::function<void()>& step);
  /// Leaves out views that are off by more, and points that too few are left of.
  void drop(double most_sigmas);

  /// BundleOdometry has it.
  Eigen::Matrix3d R_base_rig(std::size_t keyframe) const { return odometry_.R_base_rig(keyframe); }
  Eigen::Isometry3d T_map_base(std::size_t keyframe) const;
  std::vector<TrackPoint3d> points() const;
  /// Of the odometry's scale error, and of position [m] and attitude (a rotation vector, axes of
  /// map) [rad] of the rig at each of these keyframes; behind them of BundleOdometry's
  /// extrinsicsError(), where there is one. To be called last: views are weighed by all
  /// that they share from then on. @throws std::runtime_error when nothing tells it
  /// @param keyframes  each once
  Eigen::MatrixXd covariance(const std::vector<std::size_t>& keyframes);
  std::size_t views() const;                        ///< that count
  std::size_t dropped() const { return dropped_; }  ///< and those left out

 private:
  struct View {
    ceres::ResidualBlockId residual;
    std::unique_ptr<ceres::LossFunctionWrapper> weight;
  };

  void addViews();
  void addDistance(TrackPoint3d& point);
  void weighViews(double most_common_px);
  std::vector<double*> pointBlocks();

  const FlightRecord& record_;
  ceres::LossFunctionWrapper loss_;
  ceres::Problem problem_;
  KeyframeErrors poses_;
  BundleOdometry odometry_;
  std::vector<TrackPoint3d> points_;
  std::vector<std::vector<View>> views_of_;  // of each point
  double distances_grown_ = 0;               // all that are compared, by this factor's logarithm
  std::size_t dropped_ = 0;
};

}  // namespace ardrone_vslam
