// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "ardrone_vslam/drone_filter.hpp"
#include "ardrone_vslam/floor_watch.hpp"
#include "ardrone_vslam/odometry_faults.hpp"

namespace ardrone_vslam {

/// One packet of the drone, with the stamp of its reception.
struct NavdataReading {
  std::int64_t stamp_ns = 0;  ///< of reception; several packets may have the same
  DroneMeasurement measured;  ///< what the packet says, in SI units
  bool is_standing = false;   ///< on the ground, motors off
};

/// One reading of its gyroscope and accelerometer.
struct DroneImu {
  std::int64_t stamp_ns = 0;                                       ///< of reception
  Eigen::Vector3d turn_rate_base_rad_s = Eigen::Vector3d::Zero();  ///< about forward, left, up
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

  /// @throws ConfigError listing every parameter out of its range
  explicit DroneObserver(const DroneFilterConfig& config);

  /// @param ready  gets the states that are ready, stamps ascending; none, one or more
  /// @return why this packet is not used; else kAccepted
  ObserverBuffer::Push push(const NavdataReading& packet, std::vector<ObserverState>& ready);
  /// The same for a reading of the IMU.
  ObserverBuffer::Push push(const DroneImu& imu, std::vector<ObserverState>& ready);
  /// Only needed where packets are missing.
  ObserverBuffer::Push push(const DroneCommandReading& command);
  /// What waits, when nothing further will come.
  void flush(std::vector<ObserverState>& ready);

  /// What was wrong with the packets so far, by cause.
  const OdometryFaultCounts& faults() const { return faults_; }

 private:
  void count(OdometryFault fault) { ++faults_[static_cast<std::size_t>(fault)]; }
  void beginAnew();
  void release(std::vector<ObserverState>& ready);
  void releaseFirst(std::vector<ObserverState>& ready);
  void takeImu(std::vector<NavdataReading>& packets, std::vector<Eigen::Vector3d>& turn_rates);
  ObserverState advance(NavdataReading packet);
  void keepYaw(NavdataReading& packet, double dt_s);
  void fly(const NavdataReading& packet, double dt_s);
  void bridge(const NavdataReading& packet, double flown_s);
  void useHeight(const NavdataReading& packet, double dt_s);

  DroneFilterConfig config_;
  DroneFilter filter_;
  FloorWatch floor_;
  std::deque<NavdataReading> packets_;  // that wait; stamps do not go back
  std::deque<DroneImu> imu_;
  std::deque<DroneCommandReading> commands_;  // of late; stamps do not go back
  std::int64_t newest_imu_ns_ = 0;            // 0: none
  std::int64_t newest_packet_ns_ = 0;         // likewise
  std::int64_t last_group_ns_ = 0;            // stamp of the packets released last; 0: none
  std::optional<NavdataReading> last_;        // as it was used
  std::int64_t first_ns_ = 0;
  double yaw_offset_rad_ = 0;  // of odom from the reported yaw
  OdometryFaultCounts faults_{};
};

}  // namespace ardrone_vslam
