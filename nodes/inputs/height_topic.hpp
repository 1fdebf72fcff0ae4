// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ardrone_vslam/Navdata.h>
#include <ros/node_handle.h>
#include <sensor_msgs/Range.h>

#include <functional>
#include <string>

#include "ardrone_vslam/height_input.hpp"
#include "input_checks/checked.hpp"

namespace ardrone_vslam {

/// The topic that heights above the floor come from: `range` or `altitude`, as the parameters say;
/// without either there is none.
class HeightTopic {
 public:
  /// Of a message that is not used: its topic, and why.
  using Refuse = std::function<void(const std::string& topic, const std::string& fault)>;

  /// @param buffer_s  readings are kept for so long
  /// @throws ConfigError
  HeightTopic(const HeightInputConfig& config, double buffer_s, Refuse refuse);
  /// Callbacks run in the queue of `nh`, at once.
  void subscribe(ros::NodeHandle& nh);

  /// @see HeightInput::at
  std::optional<double> at(const OdometryState& odometry);

  bool isUsed() const { return !name_.empty(); }
  /// range or altitude
  const std::string& name() const { return name_; }
  /// To be called once a second in which images were answered.
  void countSecond();
  int secondsWithout() const { return seconds_without_; }
  /// What is wrong once images have been without a height for seconds; else empty.
  std::string missing() const;

  /// Readings refused.
  std::uint64_t refused() const { return refused_; }
  const HeightInput& input() const { return input_; }

 private:
  void onRange(const sensor_msgs::RangeConstPtr& message);
  void onAltitude(const NavdataConstPtr& message);
  void take(const Checked<RangeReading>& reading);

  HeightInput input_;
  std::string name_;
  std::string parameter_;  ///< that asks for the heights
  Refuse refuse_;
  ros::Subscriber subscriber_;
  std::uint64_t refused_ = 0;
  bool has_height_ = false;  // near an image's stamp, within this second
  int seconds_without_ = 0;
};

}  // namespace ardrone_vslam
