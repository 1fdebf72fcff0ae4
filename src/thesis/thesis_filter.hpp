// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "ardrone_vslam/odometry_buffer.hpp"
#include "ardrone_vslam/slam_config.hpp"

namespace ardrone_vslam {

/// One matched landmark as the localisation sees it.
struct Observation {
  Eigen::Vector3d landmark_map = Eigen::Vector3d::Zero();    ///< where the map has it
  Eigen::Vector3d direction_map = Eigen::Vector3d::UnitX();  ///< measured unit ray
  double landmark_sigma_m = 0;                               ///< sigma_l
  double position_variance_m2 = 0;  ///< of the pose when the landmark was made (P_a)
};

/// A camera position by landmarks alone.
struct PositionFix {
  double distance_m = 0;          ///< weighted mean distance of the landmarks
  double shared_variance_m2 = 0;  ///< weighted mean of the observations' P_a
  Eigen::Vector3d position_map = Eigen::Vector3d::Zero();  ///< of the camera
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();    ///< of it [m^2]
};

/// The thesis's localisation (chapter 6): weighted mean of the positions that each landmark gives,
/// fused with the odometry's prediction by a Kalman filter. Orientation is the odometry's, taken as
/// drift-free.
class ThesisFilter {
 public:
  /// @throws ConfigError listing every parameter out of its range
  explicit ThesisFilter(const ThesisFilterConfig& config);

  /// Starts at a base position.
  void start(const Eigen::Vector3d& position_map, const OdometryState& odometry);
  /// Moves on by the odometry's increment since the last call; the deviation grows by the increase
  /// of the odometry's covariance or, where it gives none (positionVariance_m2), by the configured
  /// noise.
  void predict(const OdometryState& odometry);

  /// The camera's position by landmarks (6.1-6.4; `exact`: least squares over the
  /// landmarks' rays, undamped along them).
  /// @param predicted_camera_map  p_hat of (6.2)
  /// @param angle_sigma_rad   sigma_a
  /// @return nothing for fewer than `min_landmarks`, or when they fix no position
  std::optional<PositionFix> locate(const std::vector<Observation>& observations,
                                    const Eigen::Vector3d& predicted_camera_map,
                                    double angle_sigma_rad) const;

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
  PositionFix printedMean(const std::vector<Observation>& observations,
                          const Eigen::Vector3d& predicted, double sigma_a) const;
  std::optional<PositionFix> exactMean(const std::vector<Observation>& observations,
                                       const Eigen::Vector3d& predicted, double sigma_a) const;
  std::optional<PositionFix> leastSquares(const std::vector<Observation>& observations,
                                          const Eigen::Vector3d& predicted, double sigma_a,
                                          const std::vector<double>& trust) const;
  /// Weights in (0, 1] by how well each observation agrees with a camera position.
  std::vector<double> trustIn(const std::vector<Observation>& observations,
                              const Eigen::Vector3d& camera_map, double sigma_a) const;

  ThesisFilterConfig config_;
  OdometryState odometry_;
  Eigen::Vector3d position_map_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Zero();
};

}  // namespace ardrone_vslam
