// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>

#include <functional>
#include <string>

#include "conversions/conversions.hpp"
#include "stamps/stamp_guard.hpp"
#include "timing/warning_limiter.hpp"

namespace ardrone_vslam {

/// The tracker's features: hands on those that can be used, and counts what is lost up to here.
class FeaturesTopic {
 public:
  struct Calls {
    std::function<void(std::int64_t stamp_ns)> restart;  ///< time began again at this stamp
    std::function<void(const FeaturesConstPtr&)> take;
  };

  FeaturesTopic(const ros::NodeHandle& nh, Warnings& warnings, Calls calls);
  /// Callbacks run in the queue of `nh`, at once.
  void subscribe(ros::NodeHandle& nh, int queue_size);

  const std::string& name() const { return name_; }
  /// To be called once a second. @return whether anything has come within it
  bool endSecond();
  void fill(Status& status) const;

 private:
  void onFeatures(const FeaturesConstPtr& features);
  bool accept(const Features& features);

  std::string name_;
  Warnings& warnings_;
  Calls calls_;
  StampGuard stamps_;
  GapCounter gaps_;
  FeaturesConstPtr newest_;  // with what the tracker says of itself
  std::uint64_t dropped_bad_message_ = 0;
  std::uint64_t dropped_stamp_ = 0;
  bool has_come_ = false;  // within this second
  ros::Subscriber subscriber_;
};

}  // namespace ardrone_vslam
