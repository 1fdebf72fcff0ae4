// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <image_transport/image_transport.h>
#include <nodelet/nodelet.h>
#include <ros/callback_queue.h>
#include <ros/master.h>
#include <ros/spinner.h>

#include <memory>

#include "ardrone_vslam/tracker.hpp"
#include "configs/node_config.hpp"
#include "inputs/attitude_input.hpp"
#include "inputs/image_queue.hpp"
#include "timing/stage_clock.hpp"
#include "timing/stamp_guard.hpp"
#include "timing/warning_limiter.hpp"

namespace ardrone_vslam {

/// Image and camera_info in, features out (and debug_image, when someone looks). A thread of its
/// own receives, so that no image is lost unseen in roscpp's queues while the tracker works; it
/// touches `queue_` and nothing else. All other callbacks run in the nodelet's single-threaded
/// queue, so nothing else is locked.
class TrackerNodelet : public nodelet::Nodelet {
 public:
  ~TrackerNodelet() override;

 private:
  class Work;  // one call of processNext, as roscpp's queues want it

  void onInit() override;
  void readParameters();
  void subscribe();
  /// Has processNext called in the nodelet's queue.
  void wake();
  /// Works on the oldest waiting image.
  void processNext();

  void onImage(const AnyImage& message, const sensor_msgs::CameraInfo& info);
  bool acceptStamp(const std_msgs::Header& header);
  /// Makes the tracker that fits camera and image. @return false when the image must be dropped
  bool prepareTracker(const sensor_msgs::CameraInfo& info, const std::string& frame,
                      const GreyImage& image);
  void publish(const GreyImage& image, const std_msgs::Header& header);

  void drop(const std::string& topic, const std::string& fault);
  void onSecond();
  /// What is missing this second, in words; empty while images are answered.
  std::string missing(const ImageQueue::Counts& counts);
  void warnOfLosses(const ImageQueue::Counts& counts);
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);

  TrackerNodeConfig node_config_;
  TrackerConfig config_;

  std::unique_ptr<image_transport::ImageTransport> transport_;
  ros::Publisher features_pub_;
  image_transport::Publisher debug_pub_;
  ros::WallTimer timer_;
  std::unique_ptr<diagnostic_updater::Updater> diagnostics_;

  std::unique_ptr<Tracker> tracker_;
  std::uint32_t next_track_id_ = 1;  // goes on when a new tracker is made
  CameraIntrinsics camera_;
  std::string camera_frame_;
  ImageFeatures features_;
  StampGuard stamps_;
  StageClock stage_clock_;

  std::string image_topic_;
  std::string info_topic_;
  std::uint64_t processed_ = 0;
  std::uint64_t dropped_ = 0;
  std::string fault_;  // of the latest dropped image; empty once one is processed
  /// The counters a second ago.
  std::uint64_t processed_before_ = 0;
  ImageQueue::Counts counts_before_;
  double rate_hz_ = 0;
  int seconds_waiting_ = 0;
  WarningLimiter limiter_;
  ros::master::V_TopicInfo published_;  // when last looked up, while images are missing
  std::string waiting_for_;             // what is missing this second, in words
  std::string loss_;                    // what was lost this second and what helps, in words

  std::unique_ptr<AttitudeInput> attitude_;  // with use_attitude
  std::unique_ptr<ImageQueue> queue_;
  ros::CallbackQueueInterface* own_queue_ = nullptr;  // the nodelet's single-threaded one
  ros::CallbackQueue receive_queue_;
  ros::Subscriber image_sub_;
  ros::Subscriber info_sub_;
  std::unique_ptr<ros::AsyncSpinner> receiver_;  // serves receive_queue_
};

}  // namespace ardrone_vslam
