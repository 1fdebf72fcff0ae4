// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <camera_info_manager/camera_info_manager.h>
#include <diagnostic_updater/diagnostic_updater.h>
#include <image_transport/image_transport.h>
#include <nodelet/nodelet.h>

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "configs/node_config.hpp"
#include "timing/timers.hpp"
#include "video/video_source.hpp"

namespace ardrone_vslam {

/// Images of a camera or a video file, with their calibration. A thread of its own waits for them.
/// The calibration is camera_info_manager's: a yaml that cameracalibrator writes, or that the
/// service set_camera_info gives.
class CameraNodelet : public nodelet::Nodelet {
 public:
  ~CameraNodelet() override;

 private:
  void onInit() override;
  void readParameters();
  void loadCalibration();
  /// @throws std::runtime_error saying why it cannot be opened
  void open();
  void run();
  /// The camera is gone: tries once a second whether it is back.
  void reopen();
  void publish(const cv::Mat& image, const ros::Time& stamp);
  sensor_msgs::CameraInfo calibrationOf(const cv::Mat& image);
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);
  void setFault(const std::string& fault);

  CameraNodeConfig config_;
  std::unique_ptr<camera_info_manager::CameraInfoManager> calibration_;
  std::unique_ptr<VideoSource> source_;
  image_transport::CameraPublisher images_;
  std::unique_ptr<diagnostic_updater::Updater> diagnostics_;
  Timers timers_;
  std::mutex mutex_;   // of fault_
  std::string fault_;  // why no images come; else empty
  std::atomic<std::uint64_t> published_{0};
  std::atomic<bool> ends_{false};
  std::thread thread_;
};

}  // namespace ardrone_vslam
