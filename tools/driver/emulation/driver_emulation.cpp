// SPDX-License-Identifier: BSD-3-Clause
#include "driver/emulation/driver_emulation.hpp"

#include <cmath>
#include <utility>

#include "ardrone_vslam/rotation.hpp"
#include "bags/messages/bag_messages.hpp"
#include "sequences/drone_cameras.hpp"
#include "world/flight/world_flight.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kDegPerRad = 180 / M_PI;
constexpr double kDriverGravity_m_s2 = 9.8;  // the driver's, to turn g into m/s^2

/// The drone counts 2048 s (11 bits of seconds, 21 of microseconds); the driver makes a float.
float driverClock_us(double clock_s) {
  constexpr double kWrap_s = 2048;
  return static_cast<float>(std::floor(std::fmod(clock_s, kWrap_s) * 1e6));
}

std::int32_t rounded(double value) {
  return static_cast<std::int32_t>(std::lround(value));
}

/// Pressure, temperature, wind, motors and tags are not simulated: zero.
Navdata toNavdata(const DronePacket& packet) {
  const Eigen::Matrix3d& R = packet.R_odom_base;
  const Eigen::Vector3f velocity_mm_s = (packet.velocity_base_m_s * 1000).cast<float>();
  const Eigen::Vector3f force_g = (packet.specific_force_base_m_s2 / kGravity_m_s2).cast<float>();
  Navdata navdata;
  navdata.batteryPercent = static_cast<float>(std::floor(packet.battery_percent));
  navdata.state = static_cast<std::uint32_t>(packet.state);
  navdata.magX = rounded(packet.magnetic_field_base.x());
  navdata.magY = rounded(packet.magnetic_field_base.y());
  navdata.magZ = rounded(packet.magnetic_field_base.z());
  navdata.rotX = static_cast<float>(kDegPerRad * std::atan2(R(2, 1), R(2, 2)));
  navdata.rotY = static_cast<float>(kDegPerRad * std::asin(-R(2, 0)));
  navdata.rotZ = static_cast<float>(kDegPerRad * yawOf(R));
  navdata.altd = rounded(packet.altitude_m * 1000);
  navdata.vx = velocity_mm_s.x();
  navdata.vy = velocity_mm_s.y();
  navdata.vz = velocity_mm_s.z();
  navdata.ax = force_g.x();
  navdata.ay = force_g.y();
  navdata.az = force_g.z();
  navdata.tm = driverClock_us(packet.clock_s);
  return navdata;
}

/// Covariances: those of the driver's documentation, which users copy into their launch files.
sensor_msgs::Imu toImu(const DronePacket& packet, const Navdata& navdata) {
  sensor_msgs::Imu imu;
  imu.linear_acceleration = toVector(
      Eigen::Vector3f(navdata.ax, navdata.ay, navdata.az).cast<double>() * kDriverGravity_m_s2);
  imu.angular_velocity = toVector(packet.angular_rate_base_rad_s);
  Eigen::Isometry3d attitude = Eigen::Isometry3d::Identity();
  attitude.linear() = packet.R_odom_base;
  imu.orientation = toPose(attitude).orientation;
  imu.linear_acceleration_covariance = {0.1, 0, 0, 0, 0.1, 0, 0, 0, 0.1};
  imu.angular_velocity_covariance = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  imu.orientation_covariance = {1, 0, 0, 0, 1, 0, 0, 0, 1e5};
  return imu;
}

template <class Covariance>
void setDiagonal(const DronePacket::Variances& variances, Covariance& covariance) {
  for (Eigen::Index i = 0; i < variances.size(); ++i) {
    covariance[static_cast<std::size_t>(7 * i)] = variances[i];
  }
}

}  // namespace

DriverFrames driverFrames(const std::string& tf_prefix) {
  const std::string prefix = tf_prefix.empty() ? "" : tf_prefix + "/";
  return {prefix + "odom", prefix + "ardrone_base_link", prefix + "ardrone_base_frontcam",
          prefix + "ardrone_base_bottomcam"};
}

DriverEmulation::DriverEmulation(DriverFaults faults, const std::string& tf_prefix)
    : faults_(std::move(faults)), frames_(driverFrames(tf_prefix)) {}

void DriverEmulation::integrate(const DronePacket& packet, std::int64_t stamp_ns) {
  const bool first = !last_stamp_ns_;
  if (first) position_odom_m_ = {0, 0, packet.altitude_m};
  // Its "no packet yet" is the time 0, which it takes for a valid one.
  const std::int64_t start_ns = has(DriverFault::kEpochDt) ? 0 : stamp_ns;
  const double dt_s = static_cast<double>(stamp_ns - last_stamp_ns_.value_or(start_ns)) * 1e-9;
  last_stamp_ns_ = stamp_ns;
  Eigen::Matrix3d R_odom_base = packet.R_odom_base;
  if (has(DriverFault::kMirroredYaw)) {
    R_odom_base =
        Eigen::AngleAxisd(-2 * yawOf(R_odom_base), Eigen::Vector3d::UnitZ()) * R_odom_base;
  }
  const Eigen::Vector3d step_odom_m = R_odom_base * packet.velocity_base_m_s * dt_s;
  position_odom_m_.head<2>() += step_odom_m.head<2>();
  // The driver integrates no z: no fault of its first step.
  if (!first) position_odom_m_.z() += step_odom_m.z();
}

double DriverEmulation::reportedHeight_m(const Navdata& navdata) const {
  const double height_m =
      has(DriverFault::kFusedAltitude) ? navdata.altd / 1000.0 : position_odom_m_.z();
  return has(DriverFault::kWholeMetres) ? std::trunc(height_m) : height_m;
}

DriverMessages DriverEmulation::receive(const DronePacket& packet, std::int64_t stamp_ns) {
  integrate(packet, stamp_ns);
  DriverMessages messages;
  messages.navdata = toNavdata(packet);
  messages.imu = toImu(packet, messages.navdata);
  messages.mag.vector =
      toVector(Eigen::Vector3d(messages.navdata.magX, messages.navdata.magY, messages.navdata.magZ)
                   .normalized());

  Eigen::Isometry3d T_odom_base = Eigen::Isometry3d::Identity();
  T_odom_base.linear() = packet.R_odom_base;
  T_odom_base.translation() = position_odom_m_;
  T_odom_base.translation().z() = reportedHeight_m(messages.navdata);
  nav_msgs::Odometry& odometry = messages.odometry;
  odometry.pose.pose = toPose(T_odom_base);
  odometry.twist.twist.linear = toVector(packet.velocity_base_m_s);
  if (!has(DriverFault::kZeroCovariance)) {
    odometry.twist.twist.angular = toVector(packet.angular_rate_base_rad_s);
    setDiagonal(packet.pose_variances, odometry.pose.covariance);
    setDiagonal(packet.twist_variances, odometry.twist.covariance);
  }
  odometry.child_frame_id = frames_.base;
  odometry.header.stamp = toRosTime(stamp_ns);
  messages.T_odom_base =
      toTransformMessage(T_odom_base, odometry.header.stamp, frames_.odom, frames_.base);
  for (auto* header : {&messages.navdata.header, &messages.imu.header, &messages.mag.header}) {
    header->stamp = odometry.header.stamp;
    header->frame_id = frames_.base;
  }
  odometry.header.frame_id = has(DriverFault::kUnprefixedFrame) ? "odom" : frames_.odom;
  return messages;
}

std::vector<geometry_msgs::TransformStamped> DriverEmulation::cameraTransforms(
    std::int64_t stamp_ns) const {
  const ros::Time now = toRosTime(stamp_ns);
  return {toTransformMessage(cameraNamed("front").T_body_cam, now, frames_.base, frames_.front),
          toTransformMessage(cameraNamed("bottom").T_body_cam, now, frames_.base, frames_.bottom)};
}

}  // namespace ardrone_vslam
