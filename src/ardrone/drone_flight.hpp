// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "ardrone/drone_filter.hpp"
#include "ardrone/navdata_sync.hpp"
#include "ardrone_vslam/drone_observer.hpp"
#include "heights/floor_watch.hpp"

namespace ardrone_vslam {

/// Flies the filter from sample to sample: across holes by what the drone was told, over other
/// floors and from one zero of the yaw to another.
class DroneFlight {
 public:
  /// @param faults  counts what is wrong with the samples; outlives the flight
  explicit DroneFlight(OdometryFaultCounts& faults) : faults_(faults) {}

  /// The next sample is the first of a new flight.
  void reset();
  void hear(const DroneCommandReading& command);
  /// The drone's state at the sample's time; none for those before the last one.
  std::optional<OdometryState> advance(const NavdataSample& sample);

 private:
  void count(OdometryFault fault) { ++faults_[static_cast<std::size_t>(fault)]; }
  void keepYaw(NavdataReading& packet, double dt_s);
  void fly(const NavdataReading& packet, double dt_s);
  void bridge(const NavdataReading& packet, double flown_s);
  void useHeight(const NavdataReading& packet, double dt_s);

  OdometryFaultCounts& faults_;
  DroneFilter filter_;
  FloorWatch floor_{kTableStep_m};
  std::deque<DroneCommandReading> commands_;  // of late; stamps do not go back
  std::optional<NavdataReading> last_;        // as it was used
  std::int64_t first_ns_ = 0;
  double yaw_offset_rad_ = 0;  // of odom from the reported yaw
};

}  // namespace ardrone_vslam
