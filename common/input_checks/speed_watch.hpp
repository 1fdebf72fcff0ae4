// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ardrone_vslam/odometry_buffer.hpp"

namespace ardrone_vslam {

/// Notices odometry that moves faster than any drone for a second on end: most likely not in
/// metres. The positions count, as many drivers fill no twist.
class SpeedWatch {
 public:
  static constexpr double kAbsurd_m_s = 100;
  static constexpr std::int64_t kWindow_ns = 1'000'000'000;
  static constexpr std::int64_t kStep_ns = 100'000'000;  // noise and bursts of stamps average out
  static constexpr std::size_t kSteps = 5;               // at least: one jump is no speed

  /// One state, in order; O(1). States that do not ascend begin
  /// anew.
  void see(const OdometryState& state);

  /// The median speed over the first window in which it was above kAbsurd_m_s; 0 before.
  double absurd_m_s() const { return absurd_m_s_; }

 private:
  void begin(const OdometryState& state);

  std::int64_t begin_ns_ = 0;  // of the window
  std::int64_t stamp_ns_ = 0;  // of the step's begin; 0: there is none
  Eigen::Vector3d position_odom_ = Eigen::Vector3d::Zero();
  std::vector<double> speeds_m_s_;
  double absurd_m_s_ = 0;
};

/// A sentence for users. @param odometry  its subject, such as "the odometry on /odom"
std::string explainSpeed(const std::string& odometry, double speed_m_s);

}  // namespace ardrone_vslam
