// SPDX-License-Identifier: BSD-3-Clause
#include <sstream>

#include "ardrone_vslam/slam.hpp"

namespace ardrone_vslam {

std::string extrinsicsFault(const Eigen::Isometry3d& T_base_cam) {
  if (!T_base_cam.matrix().allFinite())
    return "it is not finite; correct the transform from base to camera";
  const double farthest_m = T_base_cam.translation().cwiseAbs().maxCoeff();
  if (farthest_m <= kFarthestCamera_m) return {};
  std::ostringstream fault;
  fault << "the camera is " << farthest_m << " m from base, beyond " << kFarthestCamera_m
        << " m; correct the transform (metres are asked for)";
  return fault.str();
}

}  // namespace ardrone_vslam
