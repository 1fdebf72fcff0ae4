// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <image_transport/image_transport.h>
#include <nodelet/nodelet.h>
#include <tf2_ros/transform_broadcaster.h>

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "ardrone_vslam/camera_model.hpp"
#include "configs/node_config.hpp"
#include "conversions/conversions.hpp"
#include "outputs/mapper_outputs.hpp"
#include "protocol/clock_map.hpp"
#include "protocol/drone_stream.hpp"
#include "protocol/file_descriptor.hpp"
#include "timing/warning_limiter.hpp"

namespace ardrone_vslam {

/// vslam_onboard's answers and telemetry by UDP in, the topics of tracker and mapper out. A thread
/// of its own receives; it and the timers take turns by a mutex.
class OnboardBridgeNodelet : public nodelet::Nodelet {
 public:
  ~OnboardBridgeNodelet() override;

 private:
  void onInit() override;
  void readParameters();
  void openSocket();

  /// The thread, until the nodelet ends.
  void receiveAll();
  void onDatagram(const std::uint8_t* datagram, std::size_t size);
  void onAnswer(const VslamPose& pose);
  void onTelemetry();
  void publishFeatures(std::int64_t stamp_ns);
  void publishOdomTf(const FrameResult& result);
  void onSecond();

  /// An image's stamp by this computer's clock. @return nothing for one before the newest
  std::optional<std::int64_t> toOwnClock(std::int64_t drone_ns);
  /// With same_clock: whether they are.
  void noteClock(std::int64_t drone_ns);
  void restart();
  /// Unless the same has just been said.
  void warn(const std::string& sentence);

  void publishStatus(Status& status);
  bool isSilent() const;
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& wrapper);

  OnboardBridgeConfig config_;
  Frames frames_;
  std::string camera_frame_;
  std::string receiving_at_;  // address and port

  std::unique_ptr<MapperOutputs> outputs_;
  std::unique_ptr<tf2_ros::TransformBroadcaster> broadcaster_;
  ros::Publisher status_pub_;
  ros::Publisher features_pub_;
  std::unique_ptr<image_transport::ImageTransport> transport_;
  image_transport::Publisher debug_pub_;
  ros::WallTimer map_timer_;
  ros::WallTimer second_timer_;
  std::unique_ptr<diagnostic_updater::Updater> diagnostics_;

  std::mutex mutex_;  // of all below but the thread's own
  DroneStream stream_;
  ClockMap clock_;
  std::optional<CameraModel> camera_;
  std::int64_t drone_ns_ = 0;  // stamp of the newest image, by the drone's clock
  std::int64_t own_ns_ = 0;    // and by this computer's
  std::int64_t heard_ns_ = 0;  // when something good came last, by the monotonic clock; 0: nothing
  std::uint64_t poses_ = 0;
  std::uint64_t telemetry_late_ = 0;    // of another image than the newest answer's
  std::uint64_t features_outside_ = 0;  // of the calibration's image
  Status latest_;                       // as published last
  std::string clock_fault_;             // with same_clock
  WarningLimiter limiter_;
  int seconds_without_pose_ = 0;

  FileDescriptor socket_;
  std::atomic<bool> is_stopping_{false};
  std::thread receiver_;
};

}  // namespace ardrone_vslam
