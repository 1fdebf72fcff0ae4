// SPDX-License-Identifier: BSD-3-Clause
#include "inputs/tf_input.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::uint32_t kTfQueue = 100;  // as TransformListener's

}  // namespace

TfInput::TfInput(ros::NodeHandle nh) : spinner_(1, &queue_) {
  nh.setCallbackQueue(&queue_);
  const auto listen = [this, &nh](const std::string& topic, bool is_static) {
    const boost::function<void(const Event&)> callback = [this, is_static](const Event& event) {
      take(event, is_static);
    };
    return nh.subscribe<tf2_msgs::TFMessage>(topic, kTfQueue, callback);
  };
  moving_sub_ = listen("/tf", false);
  static_sub_ = listen("/tf_static", true);
  spinner_.start();
}

void TfInput::take(const Event& event, bool is_static) {
  buffer_.take(*event.getConstMessage(), event.getPublisherName(), is_static, ros::Time::now());
}

}  // namespace ardrone_vslam
