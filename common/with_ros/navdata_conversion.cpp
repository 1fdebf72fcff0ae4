// SPDX-License-Identifier: BSD-3-Clause
#include "with_ros/navdata_conversion.hpp"

#include <cmath>

#include "with_ros/geometry_conversion.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kRadPerDeg = M_PI / 180;
constexpr double kGravity_m_s2 = 9.81;
constexpr double kPerThousand = 1e-3;
constexpr std::uint32_t kInit = 1;
constexpr std::uint32_t kLanded = 2;
constexpr const char* kNoStamp = "its stamp is zero; set header.stamp";

}  // namespace

Checked<NavdataReading> toNavdataReading(const Navdata& m) {
  if (m.header.stamp.isZero()) return {std::nullopt, kNoStamp};
  NavdataReading reading;
  reading.stamp_ns = toNanoseconds(m.header.stamp);
  reading.measured.R_odom_base =
      (Eigen::AngleAxisd(static_cast<double>(m.rotZ) * kRadPerDeg, Eigen::Vector3d::UnitZ()) *
       Eigen::AngleAxisd(static_cast<double>(m.rotY) * kRadPerDeg, Eigen::Vector3d::UnitY()) *
       Eigen::AngleAxisd(static_cast<double>(m.rotX) * kRadPerDeg, Eigen::Vector3d::UnitX()))
          .toRotationMatrix();
  reading.measured.flow_base_m_s = Eigen::Vector2f(m.vx, m.vy).cast<double>() * kPerThousand;
  reading.measured.force_base_m_s2 =
      Eigen::Vector3f(m.ax, m.ay, m.az).cast<double>() * kGravity_m_s2;
  reading.measured.height_m = m.altd * kPerThousand;
  reading.is_standing = m.state == kInit || m.state == kLanded;
  return {reading, {}};
}

Checked<RangeReading> toHeightReading(const Navdata& m) {
  if (m.header.stamp.isZero()) return {std::nullopt, kNoStamp};
  constexpr double kSonarReach_m = 6;  // beyond it the drone guesses
  constexpr double kLowest_m = 0.1;    // 0 on the ground
  return {RangeReading{toNanoseconds(m.header.stamp), m.altd * kPerThousand, kLowest_m,
                       kSonarReach_m, true},
          {}};
}

Checked<DroneImu> toDroneImu(const sensor_msgs::Imu& m) {
  if (m.header.stamp.isZero()) return {std::nullopt, kNoStamp};
  DroneImu imu;
  imu.stamp_ns = toNanoseconds(m.header.stamp);
  imu.angular_rate_base_rad_s << m.angular_velocity.x, m.angular_velocity.y, m.angular_velocity.z;
  imu.force_base_m_s2 << m.linear_acceleration.x, m.linear_acceleration.y, m.linear_acceleration.z;
  return {imu, {}};
}

DroneCommandReading toDroneCommand(const geometry_msgs::Twist& m, std::int64_t received_ns) {
  return {received_ns, {m.linear.x, m.linear.y}};
}

}  // namespace ardrone_vslam
