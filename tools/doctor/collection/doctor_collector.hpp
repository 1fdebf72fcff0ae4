// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ardrone_vslam/Navdata.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>
#include <tf2_msgs/TFMessage.h>

#include <cstdint>

#include "doctor/recording/doctor_recording.hpp"

namespace ardrone_vslam {

/// Messages -> recording, from a bag as from live topics.
class DoctorCollector {
 public:
  explicit DoctorCollector(DoctorRecording& recording) : recording_(recording) {}

  void see(const sensor_msgs::Image& message, std::int64_t received_ns);
  /// @param size_px  of the decoded image; empty when it cannot be decoded
  void see(const sensor_msgs::CompressedImage& message, const cv::Size& size_px,
           std::int64_t received_ns);
  void see(const sensor_msgs::CameraInfo& message, std::int64_t received_ns);
  void see(const nav_msgs::Odometry& message, std::int64_t received_ns);
  void see(const Navdata& message, std::int64_t received_ns);
  void see(const sensor_msgs::Imu& message, std::int64_t received_ns);
  void see(const tf2_msgs::TFMessage& message);

 private:
  DoctorRecording& recording_;
};

}  // namespace ardrone_vslam
