// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>
#include <sensor_msgs/Imu.h>

#include <optional>
#include <string>
#include <vector>

#include "ardrone_vslam/imu_odometry.hpp"
#include "inputs/extrinsics_tf.hpp"
#include "inputs/odometry_maker.hpp"

namespace ardrone_vslam {

/// Odometry and an IMU -> odometry with the IMU's attitude (odometry_mode imu). How the IMU is
/// mounted is tf's to say, once.
class ImuInput : public OdometryMaker {
 public:
  /// @param tf  outlives this
  ImuInput(ros::NodeHandle& nh, Frames frames, const ExtrinsicsTf& tf, Take take, Refuse refuse);

  void subscribe(ros::NodeHandle& nh) override;

 private:
  void onOdometry(const nav_msgs::OdometryConstPtr& message);
  void onImu(const sensor_msgs::ImuConstPtr& message);
  /// Nothing: it is not known yet; the user is told.
  std::optional<Eigen::Quaterniond> mounting(const sensor_msgs::Imu& message);
  void publishReady();

  const ExtrinsicsTf& tf_;
  std::optional<Eigen::Quaterniond> R_base_imu_;
  ImuOdometry odometry_;
  std::vector<OdometryState> ready_;  // kept for its memory
  std::uint64_t without_ = 0;         // ImuOdometry's counts, as far as they have been told
  std::uint64_t tilted_ = 0;
  std::string imu_topic_;
  std::string odometry_topic_;
  ros::Subscriber imu_sub_;
  ros::Subscriber odometry_sub_;
};

}  // namespace ardrone_vslam
