// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/Odometry.h>
#include <ros/node_handle.h>

#include <optional>
#include <string>

#include "ardrone_vslam/odometry_buffer.hpp"
#include "inputs/extrinsics_tf.hpp"

namespace ardrone_vslam {

/// The turn of the image by the odometry's attitude (topic `attitude`, the odometry's odometry).
/// An image does not wait for it: what the newest message says is near enough.
class AttitudeInput {
 public:
  static constexpr std::int64_t kOldest_ns = 100'000'000;

  /// @param image_time_offset_s  an image is exposed at its stamp plus this; `auto` is 0
  AttitudeInput(ros::NodeHandle nh, const NumberOrAuto& image_time_offset_s);

  /// @return nothing when the latest attitude is more than kOldest_ns older than the exposure, the
  ///   camera's extrinsics are not known, or gravity does not say (imageRoll_rad)
  std::optional<float> imageRoll_rad(std::int64_t stamp_ns, const std::string& camera_frame);

  std::uint64_t imagesWithout() const { return images_without_; }
  /// Why the latest image had none, with the remedy; empty if it had.
  const std::string& fault() const { return fault_; }

 private:
  void onAttitude(const nav_msgs::Odometry& message);
  std::optional<float> find(std::int64_t exposed_ns, const std::string& camera_frame);

  ExtrinsicsTf extrinsics_;
  std::int64_t image_time_offset_ns_;
  OdometryBuffer buffer_;
  std::string base_frame_;
  std::string topic_;
  std::string fault_;
  std::uint64_t images_without_ = 0;
  ros::Subscriber subscriber_;
};

}  // namespace ardrone_vslam
