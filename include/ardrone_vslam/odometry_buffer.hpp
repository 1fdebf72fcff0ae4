// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "ardrone_vslam/odometry_config.hpp"

namespace ardrone_vslam {

/// Covariance of position and rotation vector, or of linear and angular velocity.
using Matrix6d = Eigen::Matrix<double, 6, 6>;
/// Position and rotation vector, or linear and angular velocity.
using Vector6d = Eigen::Matrix<double, 6, 1>;

/// What the drone's odometry says of one instant.
struct OdometryState {
  std::int64_t stamp_ns = 0;  ///< the odometry's clock
  Eigen::Isometry3d T_odom_base =
      Eigen::Isometry3d::Identity();  ///< pose of base in the odometry's frame
  /// Of position [m^2], then rotation vector [rad^2], axes of odom; all zero when the odometry
  /// gives none. Read it through positionVariance_m2.
  Matrix6d covariance = Matrix6d::Zero();
  /// Of base, axes of base: linear [m/s], then angular [rad/s]. Only passed on; zero when unknown.
  Vector6d twist_base = Vector6d::Zero();
  Matrix6d twist_covariance = Matrix6d::Zero();  ///< in the same order
  /// Of base above the floor, measured at this very instant (HeightInput); not interpolated.
  std::optional<double> height_m = std::nullopt;
  /// How often the source was started again before, which told anew where it is (OdometryAdapter).
  std::uint32_t start = 0;
};

/// Bounds of what odometry can mean. Beyond the first two a state is refused: no drone is there,
/// and the squares of such numbers overflow.
constexpr double kFarthestOdometry_m = 1e7;  ///< of base from the origin of odom
constexpr double kFastestOdometry = 1e3;     ///< linear [m/s] and angular [rad/s]
/// A position variance above this (a sigma of 100 m) marks an unknown one: drivers write 1e5,
/// 1e6, 1e9 or the largest double.
constexpr double kLargestVariance_m2 = 1e4;
/// Twist covariances are only passed on; larger entries are cut to this.
constexpr double kLargestTwistCovariance = 1e12;

/// What is out of bounds in a state, and what helps; empty when nothing is.
std::string rangeFault(const OdometryState& state);

/// The greatest coordinate of the position, without its sign.
double farthest_m(const OdometryState& state);
/// Whether the position is too far out even for a driver that integrates from the epoch: nonsense.
bool isBeyondAllJumps(const OdometryState& message);

/// Mean position variance per axis.
/// @return nothing when the odometry gives none: all zero, negative or above kLargestVariance_m2 in
/// one axis
std::optional<double> positionVariance_m2(const OdometryState& state);

/// Why a covariance that is not all zero counts as not given; empty when it is used or all zero.
std::string covarianceFault(const OdometryState& state);

/// The odometry's recent states, interpolated at image stamps (position linearly, orientation by
/// slerp).
class OdometryBuffer {
 public:
  /// Whether a state is taken, and why not.
  enum class Push {
    kAccepted,
    kNotFinite,       ///< a number of it
    kOutOfRange,      ///< rangeFault() says what
    kDuplicateStamp,  ///< that of the state before
    kBackwardStamp    ///< before that of the state before
  };
  /// Whether there is a state at a stamp, and why not.
  enum class Lookup {
    kFound,
    kEmpty,   ///< no state has come
    kTooOld,  ///< the stamp is before the first state kept
    kNotYet,  ///< no state at or after the stamp has come
    kGap      ///< the states on both sides are further apart than max_gap_s, or of two starts
  };

  /// @throws ConfigError listing every parameter out of its range
  explicit OdometryBuffer(const OdometryBufferConfig& config);

  /// Appends a state; one that is refused changes nothing. The quaternion part is taken as
  /// normalised. A covariance that counts as not given is stored as zero, so that none is
  /// interpolated from it.
  Push push(const OdometryState& state);

  /// @param state  set only when the answer is kFound
  /// @return kNotYet while no state at or after the stamp has come; kTooOld before the first kept
  /// one; kGap when the
  ///   states on both sides are further apart than max_gap_s.
  Lookup at(std::int64_t stamp_ns, OdometryState& state) const;

  /// Forgets all states: time began again.
  void clear() { states_.clear(); }
  /// Whether there is no state.
  bool empty() const { return states_.empty(); }
  /// Oldest first.
  const std::deque<OdometryState>& states() const { return states_; }
  /// Of the last state that was accepted; 0: none.
  std::int64_t newestStamp_ns() const { return states_.empty() ? 0 : states_.back().stamp_ns; }

 private:
  OdometryBufferConfig config_;
  std::deque<OdometryState> states_;
};

/// Linear in position, covariances and twist, slerp in orientation; `a` and `b` bracket the stamp.
/// The covariance is zero where `a` or `b` gives none.
OdometryState interpolate(const OdometryState& a, const OdometryState& b, std::int64_t stamp_ns);

}  // namespace ardrone_vslam
