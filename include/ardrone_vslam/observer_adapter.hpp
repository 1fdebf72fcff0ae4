// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "ardrone_vslam/height_steps.hpp"
#include "ardrone_vslam/observer_buffer.hpp"
#include "ardrone_vslam/odometry_faults.hpp"
#include "ardrone_vslam/parameters.hpp"

namespace ardrone_vslam {

/// What of the observer is believed.
enum class ObserverMode {
  kPose,    ///< the odometry's pose
  kTwist,   ///< its twist, integrated anew, and its orientation
  kNavdata  ///< the drone's own packets (DroneObserver)
};
template <>
struct EnumNames<ObserverMode> {
  static constexpr std::array<const char*, 3> kNames{"pose", "twist", "navdata"};
};

/// Where z comes from with ObserverMode::kTwist.
enum class ObserverHeight {
  kPose,  ///< the pose's, without the steps of furniture below
  kTwist  ///< integrated as x and y are
};
template <>
struct EnumNames<ObserverHeight> {
  static constexpr std::array<const char*, 2> kNames{"pose", "twist"};
};

/// Which part of the odometry's messages is believed.
struct ObserverAdapterConfig {
  ObserverMode mode = ObserverMode::kPose;
  ObserverHeight height = ObserverHeight::kPose;
};

template <class Visitor>
void visitParameters(ObserverAdapterConfig& c, Visitor&& visit) {
  visit(
      ParameterInfo{"observer_mode", "choice", 0, 0,
                    "pose: the odometry's position is believed; twist: it is integrated anew from "
                    "the twist (axes of base) and the orientation, for drivers that integrate "
                    "wrongly (ardrone_autonomy's yaw is mirrored); navdata: the package's own "
                    "observer of the AR.Drone's topics `navdata` and `imu` takes the odometry's "
                    "place. observer_fusion needs the same"},
      c.mode);
  visit(
      ParameterInfo{"observer_height", "choice", 0, 0,
                    "observer_mode twist: z is the pose's, without steps that no climb explains (a "
                    "table below), or integrated like x and y"},
      c.height);
}

/// Odometry messages -> the states that ObserverBuffer is given. Recognises what drivers do wrong,
/// repairs what it can and counts it. Deterministic: the stamps are its only clock.
class ObserverAdapter {
 public:
  /// @throws ConfigError listing every parameter out of its range
  explicit ObserverAdapter(const ObserverAdapterConfig& config);

  /// One message, as it came: its position may be out of bounds. From the first burst of equal
  /// stamps on, messages are held until the next stamp comes, to be spread over the gap before.
  /// @param ready  gets the states that are ready, stamps ascending; none, one or a burst
  /// @return why this message, or one held before it, is not used; else kAccepted
  ObserverBuffer::Push push(const ObserverState& message, std::vector<ObserverState>& ready);

  /// What is held, when no further message will come.
  ObserverBuffer::Push flush(std::vector<ObserverState>& ready);

  /// Whether the position is too far out even for a driver that integrates from the epoch:
  /// nonsense.
  static bool isBeyondAllJumps(const ObserverState& message);

  /// What was wrong with the messages so far, by cause.
  const OdometryFaultCounts& faults() const { return faults_; }

 private:
  void count(OdometryFault fault) { ++faults_[static_cast<std::size_t>(fault)]; }
  void beginAnew();
  ObserverBuffer::Push absorb(const ObserverState& message);
  ObserverBuffer::Push adapt(const ObserverState& message, std::vector<ObserverState>& ready);
  bool follows(const ObserverState& message);
  Eigen::Vector3d wayByTwist_m(const ObserverState& message) const;
  void watchTwist(const ObserverState& message, const Eigen::Vector3d& raw_way_m);
  double heightByTwist_m(const ObserverState& message, double vertical_way_m) const;

  ObserverAdapterConfig config_;
  OdometryFaultCounts faults_{};
  WholeMetresWatch whole_metres_;
  HeightSteps height_steps_;  // observer_mode twist with the pose's height

  bool is_bursting_ = false;  // a burst has been seen since the stamps began
  std::vector<ObserverState> held_;
  std::int64_t newest_ns_ = 0;              // of the messages; 0: none
  std::optional<ObserverState> last_;       // message that was used, its stamp spread
  std::optional<ObserverState> candidate_;  // message that jumped, until one agrees with it
  Eigen::Vector3d position_odom_m_ = Eigen::Vector3d::Zero();  // last answer
  Eigen::Vector3d offset_odom_m_ = Eigen::Vector3d::Zero();    // of the answers from the messages
  // Of last_, should it be the first of a burst: the gap before it, sum and number of the mean
  // speeds in it.
  double gap_s_ = 0;
  Eigen::Vector3d speeds_m_s_ = Eigen::Vector3d::Zero();
  int absorbed_ = 1;
  double without_twist_m_ = 0;  // way of the poses while the twist is zero
};

}  // namespace ardrone_vslam
