// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "ardrone_vslam/odometry_buffer.hpp"
#include "ardrone_vslam/odometry_config.hpp"
#include "ardrone_vslam/odometry_faults.hpp"

namespace ardrone_vslam {

/// What the drone measures at one time.
struct DroneMeasurement {
  Eigen::Matrix3d R_odom_base = Eigen::Matrix3d::Identity();  ///< as reported
  Eigen::Vector2d flow_base_m_s = Eigen::Vector2d::Zero();    ///< forward, left
  Eigen::Vector3d force_base_m_s2 = Eigen::Vector3d::Zero();  ///< specific force
  double height_m = 0;  ///< above what is below; at most 0: not measured
};

/// One packet of the drone, with the stamp of its reception.
struct NavdataReading {
  std::int64_t stamp_ns = 0;  ///< of reception; several packets may have the same
  DroneMeasurement measured;  ///< what the packet says, in SI units
  bool is_standing = false;   ///< on the ground, motors off
};

/// One reading of its gyroscope and accelerometer.
struct DroneImu {
  std::int64_t stamp_ns = 0;                                          ///< of reception
  Eigen::Vector3d angular_rate_base_rad_s = Eigen::Vector3d::Zero();  ///< about forward, left, up
  Eigen::Vector3d force_base_m_s2 = Eigen::Vector3d::Zero();  ///< specific force: forward, left, up
};

/// What the drone's controller was told: cmd_vel's x and y.
struct DroneCommandReading {
  std::int64_t stamp_ns = 0;                       ///< when it was sent
  Eigen::Vector2d tilt = Eigen::Vector2d::Zero();  ///< forward and left, within +-1
};

/// The package's own observer: packets and IMU of an AR.Drone -> states with covariance, the same
/// as an odometry's. Packets wait for the next stamp, of both, so that packets that came together
/// are spread over the gap before; of an IMU that stays out for kLongestWait_ns nothing is waited
/// for. Deterministic: the stamps are its only clock, the order between the two does not matter.
class DroneObserver {
 public:
  /// Packets wait no longer for an IMU reading.
  static constexpr std::int64_t kLongestWait_ns = 100'000'000;

  DroneObserver();
  ~DroneObserver();
  DroneObserver(DroneObserver&&) noexcept;             ///< takes all that waits along
  DroneObserver& operator=(DroneObserver&&) noexcept;  ///< likewise

  /// @param ready  gets the states that are ready, stamps ascending; none, one or more
  /// @return why this packet is not used; else kAccepted
  OdometryBuffer::Push push(const NavdataReading& packet, std::vector<OdometryState>& ready);
  /// The same for a reading of the IMU.
  OdometryBuffer::Push push(const DroneImu& imu, std::vector<OdometryState>& ready);
  /// Only needed where packets are missing.
  OdometryBuffer::Push push(const DroneCommandReading& command);
  /// What waits, when nothing further will come.
  void flush(std::vector<OdometryState>& ready);

  /// What was wrong with the packets so far, by cause.
  const OdometryFaultCounts& faults() const;

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace ardrone_vslam
