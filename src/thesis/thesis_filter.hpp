// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "ardrone_vslam/odometry_buffer.hpp"
#include "ardrone_vslam/slam_config.hpp"
#include "map/landmark_locator.hpp"

namespace ardrone_vslam {

/// The thesis's fusion (chapter 6): a Kalman filter of base's position, predicted by the odometry
/// and corrected by the position that landmarks give. Orientation is the odometry's, taken as
/// drift-free.
class ThesisFilter {
 public:
  /// @throws ConfigError listing every parameter out of its range
  explicit ThesisFilter(const ThesisFilterConfig& config);

  /// Starts at a base position.
  void start(const Eigen::Vector3d& position_map, const OdometryState& odometry);
  /// Moves on by the odometry's increment since the last call; the sigma grows by the increase
  /// of the odometry's covariance or, where it gives none (positionVariance_m2), by the configured
  /// noise.
  void predict(const OdometryState& odometry);

  /// Kalman fusion (6.8-6.12) of a base position.
  /// @return false when the fix fails its gate; the prediction then stands
  bool fuse(const PositionFix& base_fix);

  /// Of base, fused.
  const Eigen::Vector3d& position_map() const { return position_map_; }
  /// Of position_map() [m^2].
  const Eigen::Matrix3d& covariance() const { return covariance_; }
  /// Per axis: root of the mean variance.
  double sigma_m() const;

 private:
  ThesisFilterConfig config_;
  OdometryState odometry_;
  Eigen::Vector3d position_map_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Zero();
};

}  // namespace ardrone_vslam
