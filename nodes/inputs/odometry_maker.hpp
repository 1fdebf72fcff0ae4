// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/Odometry.h>
#include <ros/node_handle.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "ardrone_vslam/odometry_buffer.hpp"
#include "ardrone_vslam/odometry_faults.hpp"

namespace ardrone_vslam {

/// Odometry that the package makes itself of other topics. It is published (`observer_odometry`)
/// and handed on as if it had been received.
class OdometryMaker {
 public:
  struct Frames {
    std::string odom = "";  ///< empty: the maker's own choice
    std::string base = "";  ///< empty: that of the messages
    std::string tf_prefix = "";
  };
  using Take = std::function<void(const nav_msgs::OdometryConstPtr&)>;
  /// Of a message that is not used: its topic, and why.
  using Refuse = std::function<void(const std::string& topic, const std::string& fault)>;

  virtual ~OdometryMaker() = default;
  /// From now on callbacks run in the queue of `nh`, at once.
  virtual void subscribe(ros::NodeHandle& nh) = 0;
  /// What was wrong with the messages so far, by cause.
  virtual OdometryFaultCounts faults() const { return {}; }

 protected:
  static constexpr std::uint32_t kQueue = 2000;  ///< 10 s at 200 Hz, in and out

  OdometryMaker(ros::NodeHandle& nh, Frames frames, Take take, Refuse refuse);

  Frames& names() { return frames_; }
  void refuse(const std::string& topic, const std::string& fault) const { refuse_(topic, fault); }
  /// Publishes the states and hands them on; then there are none.
  void handOn(std::vector<OdometryState>& ready);

 private:
  Frames frames_;
  Take take_;
  Refuse refuse_;
  ros::Publisher odometry_pub_;
};

}  // namespace ardrone_vslam
