// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/master.h>

#include <string>

#include "timing/clock_watch.hpp"
#include "timing/warning_limiter.hpp"
#include "tracker/image_receiver.hpp"

namespace ardrone_vslam {

/// Says which input is missing, or lost before it could be used.
class ImageWatch {
 public:
  ImageWatch(const ImageReceiver& receiver, Warnings& warnings)
      : receiver_(receiver), warnings_(warnings) {}

  /// To be called once a second.
  void endSecond();
  /// What was missing this second, in words; empty while images come.
  const std::string& waitingFor() const { return waiting_for_; }
  /// What was lost this second and what helps, in words.
  const std::string& loss() const { return loss_; }

 private:
  std::string missing(const ImageQueue::Counts& counts);
  void warnOfLosses(const ImageQueue::Counts& counts);

  const ImageReceiver& receiver_;
  Warnings& warnings_;
  ImageQueue::Counts before_;  // a second ago
  int seconds_waiting_ = 0;
  ClockWatch clock_;
  ros::master::V_TopicInfo published_;  // when last looked up, while images are missing
  std::string waiting_for_;
  std::string loss_;
};

}  // namespace ardrone_vslam
