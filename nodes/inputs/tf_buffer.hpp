// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tf2/buffer_core.h>
#include <tf2_msgs/TFMessage.h>

#include <cstdint>
#include <map>
#include <mutex>
#include <set>
#include <string>

namespace ardrone_vslam {

/// tf2's buffer without its warning of each transform whose stamp it has already: a driver's burst
/// of packets has one stamp, a hundred times a second. Here they are left out, as there, and
/// counted; so are those older than all that is kept. Any thread may call.
class TfBuffer {
 public:
  static const ros::Duration kCache;

  TfBuffer() : buffer_(kCache) {}

  /// @param now  ROS's time: when it goes back, what is known of before is forgotten
  void take(const tf2_msgs::TFMessage& message, const std::string& sender, bool is_static,
            const ros::Time& now);
  /// Forgets all but the static transforms.
  void clear();

  std::uint64_t repeated() const;
  std::uint64_t tooOld() const;
  const tf2::BufferCore& core() const { return buffer_; }

 private:
  /// Whether a transform has a stamp that the buffer can use; counts it if not.
  bool isNew(const std::string& child_frame, const ros::Time& stamp);
  void forget();

  tf2::BufferCore buffer_;  // locks for itself
  mutable std::mutex mutex_;
  std::map<std::string, std::set<ros::Time>> stamps_;  // in the buffer, by child frame
  ros::Time latest_now_;
  std::uint64_t repeated_ = 0;
  std::uint64_t too_old_ = 0;
};

/// What is wrong when the odometry's frame is not above its base in tf, although tf has something
/// above it: map -> odom would hang beside tf's tree. Says what to set; empty: nothing is wrong.
std::string odomFrameFault(const tf2::BufferCore& tf, const std::string& map_frame,
                           const std::string& odom_frame, const std::string& base_frame);

}  // namespace ardrone_vslam
