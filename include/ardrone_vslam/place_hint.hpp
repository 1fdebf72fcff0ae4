// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace ardrone_vslam {

/// Where somebody says that base is: a click in a picture of the map.
struct PlaceHint {
  Eigen::Vector2d position_map_m = Eigen::Vector2d::Zero();  ///< x and y; the height is not told
  double heading_rad = 0;                                    ///< of base, about z of map
  double position_sigma_m = 0.5;                             ///< per axis
  double heading_sigma_rad = 0.26;                           ///< 15 degrees, as rviz has it
};

/// So many sigmas around a hint a place is looked for.
constexpr double kHintSigmas = 3;

}  // namespace ardrone_vslam
