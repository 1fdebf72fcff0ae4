// SPDX-License-Identifier: BSD-3-Clause
#include "with_ros/imu_conversion.hpp"

#include "with_ros/geometry_conversion.hpp"

namespace ardrone_vslam {

Checked<ImuAttitude> toImuAttitude(const sensor_msgs::Imu& message,
                                   const Eigen::Quaterniond& R_base_imu) {
  if (message.header.stamp.isZero()) return {std::nullopt, "its stamp is zero; set header.stamp"};
  // sensor_msgs/Imu: -1 says that there is no orientation; some drivers leave it zero instead.
  const auto& q = message.orientation;
  const bool is_given = q.x != 0 || q.y != 0 || q.z != 0 || q.w != 0;
  if (message.orientation_covariance[0] == -1 || !is_given)
    return {std::nullopt,
            "it has no orientation: a filter of gyroscope and accelerometer makes one "
            "(imu_filter_madgwick, imu_complementary_filter)"};
  geometry_msgs::Pose pose;
  pose.orientation = q;
  const auto T_world_imu = toIsometry(pose);
  if (!T_world_imu.value) return {std::nullopt, T_world_imu.fault};
  ImuAttitude attitude;
  attitude.stamp_ns = toNanoseconds(message.header.stamp);
  attitude.R_world_base = Eigen::Quaterniond(T_world_imu.value->linear()) * R_base_imu.inverse();
  return {attitude, {}};
}

}  // namespace ardrone_vslam
