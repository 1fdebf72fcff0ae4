// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "ardrone_vslam/camera_model.hpp"

namespace ardrone_vslam::bench {

using Pixels = std::vector<Eigen::Vector2d>;
/// Unit directions, NaN where there is none.
using Directions = std::vector<Eigen::Vector3d>;

/// A way to correct pixels.
struct LensMethod {
  std::string name;
  std::string key;  // of the map of errors; empty: not drawn
  std::function<void(const Pixels&, Directions&)> correct;
};

/// Coefficients of the series whose product with a distorted radius is the undistorted one, in
/// powers of the squared distorted radius from the first on: Drap & Lefevre's closed form, to as
/// many terms as are asked for.
std::vector<double> inverseSeries(const CameraIntrinsics& camera, int terms);

/// The package's ways as the tracker calls them (table, closed form, Newton), table and closed form
/// with 3 and with more terms in a loop of their own, and OpenCV's.
std::vector<LensMethod> lensMethods(const CameraIntrinsics& camera);

}  // namespace ardrone_vslam::bench
