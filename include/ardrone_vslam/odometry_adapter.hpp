// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "ardrone_vslam/height_jumps.hpp"
#include "ardrone_vslam/odometry_buffer.hpp"
#include "ardrone_vslam/odometry_config.hpp"
#include "ardrone_vslam/odometry_faults.hpp"

namespace ardrone_vslam {

/// Odometry messages -> the states that OdometryBuffer is given. Recognises what drivers do wrong,
/// repairs what it can and counts it. Deterministic: the stamps are its only clock.
class OdometryAdapter {
 public:
  /// @throws ConfigError listing every parameter out of its range
  explicit OdometryAdapter(const OdometryAdapterConfig& config);

  /// One message, as it came: its position may be out of bounds. From the first burst of equal
  /// stamps on, messages are held until the next stamp comes, to be spread over the gap before.
  /// @param ready  gets the states that are ready, stamps ascending; none, one or a burst
  /// @return why this message, or one held before it, is not used; else kAccepted
  OdometryBuffer::Push push(const OdometryState& message, std::vector<OdometryState>& ready);

  /// What is held, when no further message will come.
  OdometryBuffer::Push flush(std::vector<OdometryState>& ready);

  /// Whether the position is too far out even for a driver that integrates from the epoch:
  /// nonsense.
  static bool isBeyondAllJumps(const OdometryState& message);

  /// What was wrong with the messages so far, by cause.
  const OdometryFaultCounts& faults() const { return faults_; }

 private:
  void count(OdometryFault fault) { ++faults_[static_cast<std::size_t>(fault)]; }
  void beginAnew();
  OdometryBuffer::Push addToBurst(const OdometryState& message);
  OdometryBuffer::Push absorb(const OdometryState& message);
  OdometryBuffer::Push adapt(const OdometryState& message, std::vector<OdometryState>& ready);
  bool follows(const OdometryState& message);
  Eigen::Vector3d wayByTwist_m(const OdometryState& message) const;
  double heightByTwist_m(const OdometryState& state, double climb_m) const;
  void moveByTwist(const Eigen::Vector3d& way_m, OdometryState& state);

  /// What became of the time before a message.
  struct Gap {
    double duration_s = 0;
    Eigen::Vector3d speeds_m_s = Eigen::Vector3d::Zero();  // sum of the mean speeds in it
    int speed_count = 1;
  };

  OdometryAdapterConfig config_;
  OdometryFaultCounts faults_{};
  WholeMetresWatch whole_metres_;
  MissingTwistWatch missing_twist_;
  HeightJumpDetector height_jumps_;  // odometry_mode twist with the pose's height

  // Messages of one stamp, of which there may be more; there from the first burst on.
  std::optional<std::vector<OdometryState>> held_;
  std::int64_t newest_ns_ = 0;              // of the messages; 0: none
  std::optional<OdometryState> last_;       // message that was used, its stamp spread
  std::optional<OdometryState> candidate_;  // message that jumped, until one agrees with it
  Eigen::Vector3d position_odom_m_ = Eigen::Vector3d::Zero();  // last answer
  Eigen::Vector3d offset_odom_m_ = Eigen::Vector3d::Zero();    // of the answers from the messages
  Gap gap_;  // before last_, should it be the first of a burst
};

}  // namespace ardrone_vslam
