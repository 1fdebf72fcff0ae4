// SPDX-License-Identifier: BSD-3-Clause
#include "bags/bag_cameras.hpp"

#include <rosbag/view.h>
#include <sensor_msgs/CameraInfo.h>

#include <algorithm>
#include <stdexcept>

#include "bags/bag_poses.hpp"
#include "bags/messages/bag_read_message.hpp"
#include "bags/messages/camera_info.hpp"

namespace ardrone_vslam {

BagCameras::BagCameras(const rosbag::Bag& bag, const std::string& camera_info_topic,
                       const BagReadOptions& options, BagFindings& findings) {
  if (options.camera) {
    cameras_.push_back({{}, {}, *options.camera});
    return;
  }
  bool has_changed = false;
  rosbag::View view(bag, rosbag::TopicQuery(camera_info_topic));
  for (const rosbag::MessageInstance& instance : view) {
    const auto message = readMessage<sensor_msgs::CameraInfo>(instance);
    if (!message) continue;
    const CameraIntrinsics intrinsics =
        intrinsicsFromCameraInfo(*message, bag.getFileName() + ", " + camera_info_topic,
                                 {options.rectified, options.rescale_calibration});
    const std::string frame = withoutSlash(message->header.frame_id);
    const auto known = std::find_if(cameras_.begin(), cameras_.end(),
                                    [&](const Camera& one) { return one.info_frame == frame; });
    if (known == cameras_.end()) {
      cameras_.push_back({frame, {}, intrinsics});
    } else if (!(known->intrinsics == intrinsics) && !has_changed) {
      has_changed = true;
      findings.warn(camera_info_topic, "the calibration of " +
                                           (frame.empty() ? "the camera" : frame) +
                                           " changes; only the first one is used");
    }
  }
  if (cameras_.empty()) {
    throw std::runtime_error(bag.getFileName() + ", " + camera_info_topic +
                             ": holds no message; give the calibration as a file by --camera");
  }
}

std::optional<std::size_t> BagCameras::find(const std::string& image_frame) {
  const auto is_of = [&](const Camera& one) {
    return one.image_frame.empty() ? one.info_frame == image_frame : one.image_frame == image_frame;
  };
  auto found = std::find_if(cameras_.begin(), cameras_.end(), is_of);
  if (found == cameras_.end() && cameras_.size() == 1 && cameras_.front().image_frame.empty())
    found = cameras_.begin();
  if (found == cameras_.end()) return std::nullopt;
  found->image_frame = image_frame;
  return static_cast<std::size_t>(found - cameras_.begin());
}

}  // namespace ardrone_vslam
