// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <image_transport/publisher.h>
#include <image_transport/subscriber_filter.h>
#include <message_filters/subscriber.h>
#include <message_filters/time_synchronizer.h>
#include <nodelet/nodelet.h>
#include <ros/master.h>
#include <sensor_msgs/CameraInfo.h>

#include <memory>

#include "ardrone_vslam/tracker.hpp"
#include "image_input.hpp"
#include "node_config.hpp"
#include "stage_clock.hpp"
#include "stamp_guard.hpp"
#include "warning_limiter.hpp"

namespace ardrone_vslam {

/// Image and camera_info in, features out (and debug_image, when someone looks). All callbacks run
/// in the nodelet's single-threaded queue, so nothing here is locked.
class TrackerNodelet : public nodelet::Nodelet {
 private:
  void onInit() override;
  void readParameters();
  void subscribe();

  template <class Message>
  void onImage(const boost::shared_ptr<const Message>& message,
               const sensor_msgs::CameraInfoConstPtr& info);
  bool acceptStamp(const std_msgs::Header& header);
  /// Makes the tracker that fits camera and image. @return false when the image must be dropped
  bool prepareTracker(const sensor_msgs::CameraInfo& info, const std::string& frame,
                      const GreyImage& image);
  void publish(const GreyImage& image, const std_msgs::Header& header);

  void drop(const std::string& topic, const std::string& fault);
  void onSecond();
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);

  TrackerNodeConfig node_config_;
  TrackerConfig config_;

  std::unique_ptr<image_transport::ImageTransport> transport_;
  image_transport::SubscriberFilter raw_;
  message_filters::Subscriber<sensor_msgs::CompressedImage> compressed_;
  message_filters::Subscriber<sensor_msgs::CameraInfo> info_;
  std::unique_ptr<message_filters::TimeSynchronizer<sensor_msgs::Image, sensor_msgs::CameraInfo>>
      raw_sync_;
  std::unique_ptr<
      message_filters::TimeSynchronizer<sensor_msgs::CompressedImage, sensor_msgs::CameraInfo>>
      compressed_sync_;
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
  std::uint64_t images_ = 0;  // received, with or without camera_info
  std::uint64_t infos_ = 0;
  std::string fault_;  // of the latest dropped image; empty once one is processed
  /// The counters a second ago.
  std::uint64_t processed_before_ = 0;
  std::uint64_t dropped_before_ = 0;
  std::uint64_t images_before_ = 0;
  std::uint64_t infos_before_ = 0;
  double rate_hz_ = 0;
  int seconds_waiting_ = 0;
  WarningLimiter limiter_;
  ros::master::V_TopicInfo published_;  // when last looked up, while images are missing
  std::string waiting_for_;             // what is missing this second, in words
};

}  // namespace ardrone_vslam
