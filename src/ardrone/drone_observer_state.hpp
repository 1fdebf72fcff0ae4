// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "ardrone/drone_filter.hpp"
#include "ardrone_vslam/drone_observer.hpp"
#include "heights/floor_watch.hpp"

namespace ardrone_vslam {

/// What DroneObserver does and remembers.
class DroneObserver::State {
 public:
  explicit State(const DroneFilterConfig& config);
  OdometryBuffer::Push push(const NavdataReading& packet, std::vector<OdometryState>& ready);
  OdometryBuffer::Push push(const DroneImu& imu, std::vector<OdometryState>& ready);
  OdometryBuffer::Push push(const DroneCommandReading& command);
  void flush(std::vector<OdometryState>& ready);
  const OdometryFaultCounts& faults() const { return faults_; }

 private:
  void count(OdometryFault fault) { ++faults_[static_cast<std::size_t>(fault)]; }
  void beginAnew();
  void release(std::vector<OdometryState>& ready);
  void releaseFirst(std::vector<OdometryState>& ready);
  void takeImu(std::vector<NavdataReading>& packets, std::vector<Eigen::Vector3d>& turn_rates);
  OdometryState advance(NavdataReading packet);
  void keepYaw(NavdataReading& packet, double dt_s);
  void fly(const NavdataReading& packet, double dt_s);
  void bridge(const NavdataReading& packet, double flown_s);
  void useHeight(const NavdataReading& packet, double dt_s);

  DroneFilterConfig config_;
  DroneFilter filter_;
  FloorWatch floor_{kTableStep_m};
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
