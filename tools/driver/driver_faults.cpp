// SPDX-License-Identifier: BSD-3-Clause
#include "driver/driver_faults.hpp"

#include <stdexcept>

namespace ardrone_vslam {

const std::vector<DriverFaultInfo>& driverFaults() {
  static const std::vector<DriverFaultInfo> all = {
      {DriverFault::kMirroredYaw, "mirrored_yaw",
       "the odometry's x and y are integrated with the yaw mirrored", true},
      {DriverFault::kEpochDt, "epoch_dt",
       "restarted halfway through the flight, its first time step is that since 1970", false},
      {DriverFault::kZeroCovariance, "zero_covariance",
       "the odometry's covariances and turn rate are zero", true},
      {DriverFault::kFusedAltitude, "fused_altitude",
       "the odometry's z is the height above what is below", true},
      {DriverFault::kWholeMetres, "whole_metres",
       "the odometry's z is cut to whole metres, as before 1.4.1", false},
      {DriverFault::kUnprefixedFrame, "unprefixed_frame",
       "under a tf prefix the odometry's frame_id lacks it", false},
      {DriverFault::kBursts, "bursts",
       "gaps of 30 ms, then six packets with one stamp; images 75 to 100 ms late", true},
      {DriverFault::kUnscaledCameraInfo, "unscaled_camera_info",
       "a calibration made at another size, of which only width and height are adapted", false},
      {DriverFault::kTogglecam, "togglecam",
       "the other camera streams in the flight's middle third", false},
  };
  return all;
}

DriverFaults driverFaultsNamed(const std::vector<std::string>& names) {
  DriverFaults faults;
  for (const std::string& name : names) {
    bool known = false;
    std::string known_names = "all, released";
    for (const DriverFaultInfo& info : driverFaults()) {
      known_names += ", " + info.name;
      if (name != info.name && name != "all" && name != "released") continue;
      known = true;
      if (name != "released" || info.released) faults.insert(info.fault);
    }
    if (!known) {
      throw std::invalid_argument("the driver has no fault '" + name + "'; known are " +
                                  known_names);
    }
  }
  return faults;
}

std::string nameList(const DriverFaults& faults) {
  std::string list;
  for (const DriverFaultInfo& info : driverFaults()) {
    if (faults.count(info.fault) > 0) list += (list.empty() ? "" : ", ") + info.name;
  }
  return list.empty() ? "none" : list;
}

}  // namespace ardrone_vslam
