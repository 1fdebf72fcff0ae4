// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/DiagnosticStatusWrapper.h>
#include <tf2/buffer_core.h>

#include <string>
#include <utility>

#include "conversions/conversions.hpp"
#include "input_checks/speed_watch.hpp"
#include "input_checks/standstill_watch.hpp"
#include "timing/warning_limiter.hpp"

namespace ardrone_vslam {

/// What is odd about the odometry that comes: warns of it, and remembers it for status and
/// diagnostics.
class OdometryWatch {
 public:
  OdometryWatch(std::string topic, Warnings& warnings)
      : topic_(std::move(topic)), warnings_(warnings) {}

  /// Of each message: says once that its covariance counts as not given, and why.
  void seeMessage(const OdometryState& message);
  /// Of each state: says once that the odometry is too fast to be in metres.
  void seeState(const OdometryState& state);
  /// Of all messages so far: says what has been found since this was called last.
  void seeFaults(const OdometryFaultCounts& faults);
  /// Of each image: the odometry's jump, 0 for none.
  void seeStep(double step_m);
  /// Of each image: whether the odometry moves as its tracks do.
  void seeImage(const ImageFeatures& features, const Eigen::Isometry3d& T_odom_cam) {
    standstill_.see(features, T_odom_cam);
  }
  /// Says once that the odometry's frame is not the one that tf has.
  void seeFrames(const tf2::BufferCore& tf, const Frames& frames);

  void changeCamera() { standstill_.reset(); }
  void beginMapAnew();

  /// Whether the odometry stands still although the camera moves.
  bool isStuck() const { return standstill_.isStuck(); }
  bool isWell() const { return speed_.absurd_m_s() == 0 && frame_fault_.empty(); }
  /// Of a speed that cannot be; else empty.
  std::string speedFault() const;

  /// Jumps so far.
  std::uint64_t steps() const { return steps_; }
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& wrapper) const;

 private:
  std::string subject() const { return "the odometry on " + topic_; }

  std::string topic_;
  Warnings& warnings_;
  StandstillWatch standstill_;
  SpeedWatch speed_;
  OdometryFaultCounts faults_{};  // those that were said
  std::uint64_t steps_ = 0;
  std::string covariance_fault_;  // since the first such message
  std::string frame_fault_;       // since it was seen
};

}  // namespace ardrone_vslam
