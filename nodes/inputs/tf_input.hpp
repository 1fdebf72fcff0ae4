// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>

#include "inputs/tf_buffer.hpp"

namespace ardrone_vslam {

/// /tf and /tf_static into a TfBuffer, by a thread of its own: in place of tf2_ros'
/// TransformListener, which cannot be kept from warning of what drivers send twice.
class TfInput {
 public:
  explicit TfInput(ros::NodeHandle nh);

  TfBuffer& buffer() { return buffer_; }
  const TfBuffer& buffer() const { return buffer_; }

 private:
  using Event = ros::MessageEvent<const tf2_msgs::TFMessage>;
  void take(const Event& event, bool is_static);

  TfBuffer buffer_;
  ros::CallbackQueue queue_;
  ros::Subscriber moving_sub_;
  ros::Subscriber static_sub_;
  ros::AsyncSpinner spinner_;  // serves queue_
};

}  // namespace ardrone_vslam
