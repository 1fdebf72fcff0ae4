// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nodelet/nodelet.h>
#include <tf2_ros/transform_broadcaster.h>

#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "bridge/bridge_status.hpp"
#include "bridge/datagram_receiver.hpp"
#include "bridge/drone_clock.hpp"
#include "bridge/features_output.hpp"
#include "configs/node_config.hpp"
#include "outputs/mapper_outputs.hpp"
#include "protocol/drone_stream.hpp"
#include "timing/timers.hpp"
#include "timing/warning_limiter.hpp"

namespace ardrone_vslam {

/// vslam_onboard's answers and telemetry by UDP in, the topics of tracker and mapper out. The
/// receiver's thread and the timers take turns by a mutex.
class OnboardBridgeNodelet : public nodelet::Nodelet {
 private:
  void onInit() override;
  void readParameters();
  void readCamera(const std::string& tf_prefix);
  void openSocket();

  void onDatagram(const std::uint8_t* datagram, std::size_t size);
  void onAnswer(const VslamPose& pose);
  void onTelemetry();
  void publishPose(const FrameResult& result);
  void publishOdomTf(const FrameResult& result);
  void restart();

  OnboardBridgeConfig config_;
  Frames frames_;
  Warnings warnings_{[this](const std::string& sentence) { NODELET_WARN_STREAM(sentence); }};
  std::mutex mutex_;  // of all below but the receiver
  DroneStream stream_;
  std::unique_ptr<DroneClock> clock_;
  std::unique_ptr<MapperOutputs> outputs_;
  std::unique_ptr<FeaturesOutput> features_;  // with a calibration
  std::unique_ptr<tf2_ros::TransformBroadcaster> broadcaster_;
  std::unique_ptr<BridgeStatus> status_;
  // Last, as they call: they end first.
  Timers timers_;
  std::unique_ptr<DatagramReceiver> receiver_;
};

}  // namespace ardrone_vslam
