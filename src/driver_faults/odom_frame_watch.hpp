// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>

#include "ardrone_vslam/odometry_buffer.hpp"
#include "ardrone_vslam/odometry_faults.hpp"

namespace ardrone_vslam {

/// Tells where a driver's frame is another one than before: its heading jumped, by more than a
/// third of a radian beyond the rate so far (gaps of 0.8 s and more hide that), or it was started
/// again. A second jump within a minute ends another odometry, whose way is worth nothing: a start,
/// too. O(1) a message.
class OdomFrameWatch {
 public:
  /// The next message, as it came; its stamp may be that of the one before.
  /// @return kTurn or kStartedAgain, or nothing
  std::optional<OdometryFault> see(const OdometryState& message);
  /// The message as if the heading had not jumped: heading and position go on by the twist there.
  OdometryState straightened(const OdometryState& message) const;
  /// OdometryState::start of the last message.
  std::uint32_t start() const { return start_; }

 private:
  void beginAnew();

  std::optional<OdometryState> last_;
  std::optional<OdometryState> moved_;  // the last one whose pose was a new one
  std::optional<OdometryState> jump_;   // the last message whose heading jumped
  double rate_rad_s_ = 0;               // by the poses
  Eigen::Isometry3d T_straight_odom_ = Eigen::Isometry3d::Identity();
  std::uint32_t start_ = 0;  // OdometryState::start
};

}  // namespace ardrone_vslam
