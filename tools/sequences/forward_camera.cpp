// SPDX-License-Identifier: BSD-3-Clause
#include "sequences/sequence.hpp"

namespace ardrone_vslam {

Eigen::Isometry3d forwardCamera() {
  Eigen::Isometry3d T_base_cam = Eigen::Isometry3d::Identity();
  // Columns: the camera's x (right), y (down), z (forward) in base (forward, left, up).
  T_base_cam.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return T_base_cam;
}

}  // namespace ardrone_vslam
