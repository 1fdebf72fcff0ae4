// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/CameraInfo.h>

#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>

#include "images/image_input.hpp"

namespace ardrone_vslam {

/// Stands between the thread that receives and the one that works: brings images and their
/// camera_info (equal stamps) together and keeps the newest while the tracker is busy. What is lost
/// here is counted, which the queues of roscpp and of message_filters do not do. Thread-safe.
class ImageQueue {
 public:
  struct Pair {
    AnyImage image;
    sensor_msgs::CameraInfoConstPtr info;
  };

  /// Since the start. Every image is taken, lost in one of two ways, or still here:
  /// images = taken + overflowed + without_info + waiting.
  struct Counts {
    std::uint64_t images = 0;      ///< received
    std::uint64_t infos = 0;       ///< received
    std::uint64_t paired = 0;      ///< images whose camera_info came
    std::uint64_t overflowed = 0;  ///< images that made place for newer ones
    /// Images given up whose camera_info had not come; one that comes later makes them
    /// `overflowed`.
    std::uint64_t without_info = 0;
    std::uint64_t waiting = 0;  ///< now here, with camera_info or without
  };

  /// @param capacity  pairs kept, and as many images that have no camera_info yet; at least 1
  explicit ImageQueue(std::size_t capacity);

  /// @return true when the pair that this one completes is the only one: the worker must be woken
  bool addImage(const AnyImage& image);
  bool addInfo(const sensor_msgs::CameraInfoConstPtr& info);

  /// Takes out the oldest pair. @param has_more  whether the worker must come again
  std::optional<Pair> take(bool& has_more);

  Counts counts() const;

 private:
  bool addPair(const AnyImage& image, const sensor_msgs::CameraInfoConstPtr& info);

  std::size_t capacity_;
  mutable std::mutex mutex_;
  std::deque<Pair> pairs_;
  std::deque<AnyImage> images_;                        // without camera_info, in order of arrival
  std::deque<sensor_msgs::CameraInfoConstPtr> infos_;  // without image
  std::deque<ros::Time> given_up_;                     // stamps of the newest in `without_info`
  Counts counts_;
};

}  // namespace ardrone_vslam
