// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <rosbag/bag.h>

#include <optional>
#include <string>
#include <vector>

#include "ardrone_vslam/camera_model.hpp"
#include "bags/bag_sequence.hpp"

namespace ardrone_vslam {

/// The cameras whose images share a topic (the AR.Drone's togglecam): each has an optical frame and
/// a calibration of its own.
class BagCameras {
 public:
  /// The calibration of `options`, else the first of each frame in the camera_info topic.
  /// @throws std::runtime_error naming the topic, the fault and the remedy
  BagCameras(const rosbag::Bag& bag, const std::string& camera_info_topic,
             const BagReadOptions& options, BagFindings& findings);

  /// Which camera took an image of this frame_id; nothing without a calibration. The only
  /// calibration of a bag is that of its first image, whatever its frame.
  std::optional<std::size_t> find(const std::string& image_frame);

  std::size_t size() const { return cameras_.size(); }
  const CameraIntrinsics& intrinsics(std::size_t which) const {
    return cameras_.at(which).intrinsics;
  }
  /// Of the images; empty for a camera that took none.
  const std::string& frame(std::size_t which) const { return cameras_.at(which).image_frame; }

 private:
  struct Camera {
    std::string info_frame;
    std::string image_frame;
    CameraIntrinsics intrinsics;
  };

  std::vector<Camera> cameras_;
};

}  // namespace ardrone_vslam
