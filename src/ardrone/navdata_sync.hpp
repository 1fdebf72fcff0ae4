// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "ardrone_vslam/drone_observer.hpp"

namespace ardrone_vslam {

/// A packet at its own time, with what the IMU measured then.
struct NavdataSample {
  NavdataReading packet;
  std::optional<Eigen::Vector3d> angular_rate_base_rad_s;
};

/// Puts packets and IMU readings together, which come with the stamps of their reception: see
/// DroneObserver.
class NavdataSync {
 public:
  enum class Added {
    kYes,
    kRestart,  ///< it is the first of a new run: what waited is forgotten
    kBackward  ///< its stamp is before the newest: it is not used
  };

  Added add(const NavdataReading& packet);
  /// @return whether it is used: its stamp is not before the newest, or is that of a new run
  bool add(const DroneImu& imu);

  /// Whether a packet waits.
  bool hasMore() const { return !packets_.empty(); }
  /// Whether nothing further can come to those of the oldest stamp.
  bool isFirstReady() const;
  /// The packets of the oldest stamp, spread over the gap before. @pre hasMore()
  std::vector<NavdataSample> takeFirst();

 private:
  void putImuInto(std::vector<NavdataSample>& samples);

  std::deque<NavdataReading> packets_;  // that wait; stamps do not go back
  std::deque<DroneImu> imu_;
  std::int64_t newest_imu_ns_ = 0;     // 0: none
  std::int64_t newest_packet_ns_ = 0;  // likewise
  std::int64_t last_group_ns_ = 0;     // stamp of the packets taken last; 0: none
};

}  // namespace ardrone_vslam
