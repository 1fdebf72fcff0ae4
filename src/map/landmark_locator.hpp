// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "ardrone_vslam/slam_config.hpp"
#include "map/association.hpp"
#include "map/landmark_map.hpp"
#include "matching/frame_view.hpp"

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

/// Camera positions by landmarks alone, the attitude known (thesis 6.1-6.4).
class LandmarkLocator {
 public:
  /// @throws ConfigError listing every parameter out of its range
  explicit LandmarkLocator(const LocatorConfig& config);

  /// The camera's position (6.1-6.4; `exact`: least squares over the landmarks' rays, undamped
  /// along them). O(observations).
  /// @param predicted_camera_map  p_hat of (6.2)
  /// @param angle_sigma_rad   sigma_a
  /// @return nothing for fewer than `min_landmarks`, or when they fix no position
  std::optional<PositionFix> locate(const std::vector<Observation>& observations,
                                    const Eigen::Vector3d& predicted_camera_map,
                                    double angle_sigma_rad) const;

  /// The same by matches of the map.
  /// @param view  from the predicted camera position
  std::optional<PositionFix> locate(const std::vector<Association>& matches, const FrameView& view,
                                    const LandmarkMap& map, double angle_sigma_rad) const;

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

  LocatorConfig config_;
};

}  // namespace ardrone_vslam
