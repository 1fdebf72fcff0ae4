// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "ardrone_vslam/camera_model.hpp"

namespace ardrone_vslam::bench {

/// Images whose camera's true poses are known.
struct TrueSequence {
  CameraIntrinsics camera;
  std::vector<cv::Mat> images;  ///< 8-bit grey
  std::vector<Eigen::Isometry3d> T_world_cam;
};

/// One that has yet to be read or rendered.
struct SequenceChoice {
  std::string name;
  std::function<TrueSequence()> load;
};

/// Rendered flights and, where ARDRONE_VSLAM_DATA is set, recorded sequences.
/// @param is_quick  a part of one flight only
std::vector<SequenceChoice> trackSequences(bool is_quick);

}  // namespace ardrone_vslam::bench
