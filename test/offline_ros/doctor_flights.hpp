// SPDX-License-Identifier: BSD-3-Clause
// Flights as the driver records them, for doctor.
#pragma once

#include <gtest/gtest.h>
#include <rosbag/view.h>

#include "doctor/collection/doctor_bag.hpp"
#include "doctor/doctor_examination.hpp"
#include "driver_recording.hpp"
#include "support/shipped_profiles.hpp"

namespace ardrone_vslam {

inline DoctorReport examineBag(const std::string& path) {
  return examine(readForDoctor(path, {}, {}), {});
}

/// A flight as the driver records it, 8 images a second.
class DriverFlight {
 public:
  DriverFlight(const std::string& flight, double seconds) : world_(options(flight, seconds)) {}

  void write(const DriverFaults& faults, const std::string& path) const {
    DriverBagOptions options;
    options.faults = faults;
    options.profile = test::shippedProfile("drone");
    options.tool = "test";
    writeDriverBag(world_, options, path);
  }

 private:
  static WorldOptions options(const std::string& flight, double seconds) {
    WorldOptions options;
    options.flight = flight;
    options.duration_s = seconds;
    options.rate_hz = 8;
    return options;
  }
  WorldSequence world_;
};

class DoctorBag : public testing::Test {
 protected:
  /// Painted once.
  static const DriverFlight& laps() {
    static const DriverFlight flight("laps", 10);
    return flight;
  }
  /// Long enough to tell the time offset.
  static const DriverFlight& longLaps() {
    static const DriverFlight flight("laps", 24);
    return flight;
  }
  std::string path(const std::string& name = "driver.bag") const { return folder_.file(name); }
  DoctorReport examineFlight(const DriverFaults& faults,
                             const DriverFlight& flight = laps()) const {
    flight.write(faults, path());
    return examineBag(path());
  }
  TemporaryFolder folder_;
};

/// A bag's copy without odometry, as of a driver that was not asked for it.
inline void dropOdometry(const std::string& from, const std::string& to) {
  const rosbag::Bag source(from, rosbag::bagmode::Read);
  rosbag::Bag copy(to, rosbag::bagmode::Write);
  rosbag::View view(source);
  for (const rosbag::MessageInstance& instance : view) {
    if (!instance.isType<nav_msgs::Odometry>())
      copy.write(instance.getTopic(), instance.getTime(), instance);
  }
  copy.close();
}

/// A bag's copy with the cameras turned by `turn` in tf.
inline void rotateCameras(const std::string& from, const std::string& to,
                          const Eigen::Matrix3d& turn) {
  const rosbag::Bag source(from, rosbag::bagmode::Read);
  rosbag::Bag copy(to, rosbag::bagmode::Write);
  rosbag::View view(source);
  for (const rosbag::MessageInstance& instance : view) {
    const auto tf = instance.instantiate<tf2_msgs::TFMessage>();
    if (!tf) {
      copy.write(instance.getTopic(), instance.getTime(), instance);
      continue;
    }
    for (auto& transform : tf->transforms) {
      if (transform.child_frame_id.find("cam") == std::string::npos) continue;
      const auto& q = transform.transform.rotation;
      Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
      T.linear() = Eigen::Quaterniond(q.w, q.x, q.y, q.z) * turn;
      transform.transform.rotation = toPose(T).orientation;
    }
    copy.write(instance.getTopic(), instance.getTime(), *tf);
  }
  copy.close();
}

}  // namespace ardrone_vslam
