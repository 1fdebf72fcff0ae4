// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <image_transport/image_transport.h>
#include <nodelet/nodelet.h>

#include <memory>
#include <optional>
#include <string>

#include "inputs/attitude_input.hpp"
#include "parameters/parameter_changes.hpp"
#include "stamps/stamp_guard.hpp"
#include "timing/timers.hpp"
#include "timing/warning_limiter.hpp"
#include "tracker/image_receiver.hpp"
#include "tracker/live_tracker.hpp"
#include "tracker/tracker_status.hpp"

namespace ardrone_vslam {

/// Image and camera_info in, features out (and debug_image, when someone looks). ImageReceiver has
/// a thread of its own; all callbacks run in the nodelet's single-threaded queue, so nothing here
/// is locked.
class TrackerNodelet : public nodelet::Nodelet {
 private:
  void onInit() override;
  void readParameters();
  void onImage(const AnyImage& message, const sensor_msgs::CameraInfo& info);
  /// What is wrong with the stamp; else empty.
  std::string stampFault(const std_msgs::Header& header);
  /// The image's turn, with use_attitude.
  std::optional<float> rotation_rad(const std_msgs::Header& header);
  void publish(const GreyImage& image, const std_msgs::Header& header);

  TrackerNodeConfig node_config_;
  TrackerConfig config_;
  Warnings warnings_{[this](const std::string& sentence) { NODELET_WARN_STREAM(sentence); }};
  ros::Publisher features_pub_;
  image_transport::Publisher debug_pub_;
  StampGuard stamps_;
  std::unique_ptr<AttitudeInput> attitude_;
  std::unique_ptr<LiveTracker> tracker_;
  std::unique_ptr<ParameterChanges<TrackerChanges>> changes_;
  std::unique_ptr<TrackerStatus> status_;
  // Last, as they call: they end first.
  std::unique_ptr<ImageReceiver> images_;
  Timers timers_;
};

}  // namespace ardrone_vslam
