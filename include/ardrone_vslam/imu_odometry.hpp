// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "ardrone_vslam/odometry_buffer.hpp"

namespace ardrone_vslam {

/// What an IMU says of base.
struct ImuAttitude {
  std::int64_t stamp_ns = 0;                                         ///< of the odometry's clock
  Eigen::Quaterniond R_world_base = Eigen::Quaterniond::Identity();  ///< a world whose z is up
};

/// Odometry whose attitude is an IMU's. Each displacement of the odometry is taken in base's axes
/// and laid along the IMU's attitude: wheels measure ways well and turns badly, and know no ramp.
/// The first pose is the odometry's, with the IMU's roll and pitch. Deterministic: the stamps are
/// its only clock. Cost: two products of rotations a state.
class ImuOdometry {
 public:
  /// Across no longer a hole an attitude is interpolated.
  static constexpr std::int64_t kLongestGap_ns = 100'000'000;
  /// Odometry waits no longer for the attitude at its stamp.
  static constexpr std::int64_t kLongestWait_ns = 500'000'000;

  /// @param ready  gets the states that are ready, in the order of the odometry
  /// @return why the attitude is not used; else kAccepted. One that is more than a second older
  ///   than the one before begins time anew
  OdometryBuffer::Push push(const ImuAttitude& attitude, std::vector<OdometryState>& ready);
  /// The same for the odometry, whose stamps may repeat.
  OdometryBuffer::Push push(const OdometryState& odometry, std::vector<OdometryState>& ready);

  /// States that were dropped, as there is no attitude at their stamp.
  std::uint64_t withoutAttitude() const { return without_attitude_; }
  /// States that were dropped before the first answer, as the two disagree on what is up by more
  /// than kMostTilt_deg: a world whose z points down, or a mounting that is wrong.
  std::uint64_t tilted() const { return tilted_; }
  static constexpr double kMostTilt_deg = 60;  ///< at the start

 private:
  template <class Input, class Other>
  void beginAnew(std::int64_t stamp_ns, std::int64_t old_ns, std::deque<Input>& own,
                 std::deque<Other>& other);
  void takeReady(std::vector<OdometryState>& ready);
  /// Nothing: there is none, and none will come. @pre its stamp is not after the last attitude's
  std::optional<Eigen::Quaterniond> attitudeAt(std::int64_t stamp_ns) const;
  void use(const OdometryState& odometry, const Eigen::Quaterniond& R_world_base,
           std::vector<OdometryState>& ready);
  OdometryState laid(const OdometryState& odometry, const Eigen::Quaterniond& R_world_base);

  std::deque<ImuAttitude> attitudes_;
  std::deque<OdometryState> waiting_;
  std::optional<OdometryState> last_;                                 ///< of those used, as it came
  Eigen::Isometry3d T_odom_base_ = Eigen::Isometry3d::Identity();     ///< the last answer
  Eigen::Quaterniond R_odom_world_ = Eigen::Quaterniond::Identity();  ///< about z alone
  std::uint64_t without_attitude_ = 0;
  std::uint64_t tilted_ = 0;
};

}  // namespace ardrone_vslam
