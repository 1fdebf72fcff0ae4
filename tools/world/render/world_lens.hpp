// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "ardrone_vslam/camera_model.hpp"

namespace ardrone_vslam {

/// Direction (x, y, 1) in the optical frame that Brown's model maps to the pixel; Newton's method
/// to 1e-12 of the image plane. @return false when there is none inside the model's fold
bool exactDirection(const CameraIntrinsics& camera, const Eigen::Vector2d& pixel_px,
                    Eigen::Vector3d& direction_cam);

}  // namespace ardrone_vslam
