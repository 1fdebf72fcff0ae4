// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/CameraInfo.h>

#include "ardrone_vslam/camera_model.hpp"
#include "input_checks/checked.hpp"

namespace ardrone_vslam {

/// How a camera_info is to be taken.
struct CameraInfoUse {
  bool rectified = false;  ///< the images are rectified: P without distortion instead of K and D
  /// K may be of another size than the images: ardrone_autonomy sets width and height to the
  /// stream's and leaves K as it was calibrated. K's middle tells the size, a power of two from the
  /// images'; what the drone's scaling cuts off goes alike on both sides.
  bool rescale = false;
};

/// For the tracker and for the tools that read bags, so that both judge a calibration alike.
/// Distortion models: plumb_bob, none (empty model and coefficients), and rational_polynomial whose
/// denominator is zero; every other is refused by name, and so are binned and cropped images.
Checked<CameraIntrinsics> toIntrinsics(const sensor_msgs::CameraInfo& info,
                                       const CameraInfoUse& use = {});

}  // namespace ardrone_vslam
