// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

namespace ardrone_vslam {

/// By how much what stands upright appears turned in the image, from the image's x axis towards its
/// y axis (clockwise as seen); minus the camera's roll: the orientation that FreakDescriber takes.
/// @param R_odom_cam  optical frame (x right, y down, z forward) to a frame whose z axis points up
/// @return nothing where the camera looks within 15 degrees of straight up or down: gravity then
///   says little about the image's turn
std::optional<float> imageRoll_rad(const Eigen::Matrix3d& R_odom_cam);

}  // namespace ardrone_vslam
