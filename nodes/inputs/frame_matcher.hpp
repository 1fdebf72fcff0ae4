// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ardrone_vslam/Features.h>

#include <deque>
#include <functional>
#include <optional>
#include <string>

#include "ardrone_vslam/odometry_buffer.hpp"
#include "ardrone_vslam/setup_monitor.hpp"

namespace ardrone_vslam {

/// Brings images' features and the odometry at their stamps together. Features wait in order,
/// a bounded time; the caller says what time it is.
class FrameMatcher {
 public:
  struct Frame {
    FeaturesConstPtr features;
    OdometryState odometry;  ///< interpolated at the exposure: the image's stamp plus its offset
  };

  /// @param clock  must live as long. @throws ConfigError when the buffer's parameters are invalid
  FrameMatcher(const OdometryBufferConfig& config, double wait_s, const ImageClock& clock);

  void addFeatures(const FeaturesConstPtr& features, double now_s);
  OdometryBuffer::Push addOdometry(const OdometryState& state) { return buffer_.push(state); }

  /// Takes out the oldest waiting frame if its odometry is there. Drops before it those that waited
  /// too long or whose odometry can never come.
  /// @param can_use  asked once the odometry is there: false holds the frame (its camera's
  /// extrinsics are unknown) until it is late
  std::optional<Frame> next(double now_s, const std::function<bool(const Features&)>& can_use);

  /// Time began again: forgets what belongs to the run before, that is odometry and waiting frames
  /// with stamps after this one. @return whether there was any
  bool forgetAfter(std::int64_t stamp_ns);

  std::uint64_t droppedNoOdometry() const { return dropped_no_odometry_; }
  std::uint64_t droppedHeld() const { return dropped_held_; }
  /// Why the latest frame without odometry had none.
  OdometryBuffer::Lookup lastMiss() const { return last_miss_; }
  const OdometryBuffer& odometries() const { return buffer_; }

 private:
  struct Waiting {
    FeaturesConstPtr features;
    double since_s;
  };

  OdometryBuffer buffer_;
  double wait_s_;
  const ImageClock& clock_;
  std::deque<Waiting> waiting_;
  std::uint64_t dropped_no_odometry_ = 0;
  std::uint64_t dropped_held_ = 0;
  OdometryBuffer::Lookup last_miss_ = OdometryBuffer::Lookup::kEmpty;
};

/// A sentence for users: why an image has no odometry, and what helps.
std::string explain(OdometryBuffer::Lookup miss, const std::string& odometry_topic);

/// Why an odometry message is not used; empty when it is.
std::string explain(OdometryBuffer::Push answer, const OdometryState& message);

}  // namespace ardrone_vslam
