// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>

#include <functional>
#include <string>

#include "configs/node_config.hpp"
#include "images/image_queue.hpp"

namespace ardrone_vslam {

/// Images and their camera_info, in pairs. A thread of its own receives, so that no image is lost
/// unseen in roscpp's queues while the tracker works; it touches `queue_` and nothing else.
class ImageReceiver {
 public:
  using Take = std::function<void(const AnyImage&, const sensor_msgs::CameraInfo&)>;

  /// @param take  called in `own_queue`, an image at a time
  ImageReceiver(const ros::NodeHandle& nh, ros::CallbackQueueInterface& own_queue,
                const TrackerNodeConfig& config, Take take);
  ~ImageReceiver();
  void start();

  const std::string& imageTopic() const { return image_topic_; }
  const std::string& infoTopic() const { return info_topic_; }
  ImageQueue::Counts counts() const { return queue_.counts(); }

 private:
  class Work;  // one call of takeNext, as roscpp's queues want it

  /// Has takeNext called in the nodelet's queue.
  void wake();
  /// The oldest waiting image.
  void takeNext();

  ros::CallbackQueueInterface& own_queue_;  // the nodelet's single-threaded one
  ros::NodeHandle nh_;                      // with receive_queue_
  bool is_compressed_;
  Take take_;
  std::string image_topic_;
  std::string info_topic_;
  ImageQueue queue_;
  ros::CallbackQueue receive_queue_;
  ros::Subscriber image_sub_;
  ros::Subscriber info_sub_;
  ros::AsyncSpinner receiver_;  // serves receive_queue_
};

}  // namespace ardrone_vslam
