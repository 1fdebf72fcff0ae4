// SPDX-License-Identifier: BSD-3-Clause
#include "inputs/imu_input.hpp"

#include <utility>

#include "conversions/conversions.hpp"
#include "conversions/frame_names.hpp"
#include "inputs/frame_matcher.hpp"
#include "with_ros/imu_conversion.hpp"

namespace ardrone_vslam {

ImuInput::ImuInput(ros::NodeHandle& nh, Frames frames, const ExtrinsicsTf& tf, Take take,
                   Refuse refuse)
    : OdometryMaker(nh, std::move(frames), std::move(take), std::move(refuse)),
      tf_(tf),
      imu_topic_(nh.resolveName("imu")),
      odometry_topic_(nh.resolveName("odometry")) {}

void ImuInput::subscribe(ros::NodeHandle& nh) {
  const auto hints = ros::TransportHints().tcpNoDelay();
  imu_sub_ = nh.subscribe("imu", kQueue, &ImuInput::onImu, this, hints);
  odometry_sub_ = nh.subscribe("odometry", kQueue, &ImuInput::onOdometry, this, hints);
}

void ImuInput::onOdometry(const nav_msgs::OdometryConstPtr& message) {
  const auto state = toUnboundedState(*message);
  if (!state.value) return refuse(odometry_topic_, state.fault);
  if (names().odom.empty()) names().odom = message->header.frame_id;
  if (names().base.empty()) names().base = message->child_frame_id;
  if (names().base.empty())
    return refuse(odometry_topic_,
                  "it names no child_frame_id, so that the IMU's mounting is unknown "
                  "(odometry_mode imu): set the parameter base_frame");
  const std::string fault = explain(odometry_.push(*state.value, ready_), *state.value);
  if (!fault.empty()) refuse(odometry_topic_, fault);
  publishReady();
}

void ImuInput::onImu(const sensor_msgs::ImuConstPtr& message) {
  const auto R_base_imu = mounting(*message);
  if (!R_base_imu) return;
  const auto attitude = toImuAttitude(*message, *R_base_imu);
  if (!attitude.value) return refuse(imu_topic_, attitude.fault);
  const std::string fault = explain(odometry_.push(*attitude.value, ready_), OdometryState{});
  if (!fault.empty()) refuse(imu_topic_, fault);
  publishReady();
}

std::optional<Eigen::Quaterniond> ImuInput::mounting(const sensor_msgs::Imu& message) {
  if (R_base_imu_ || names().base.empty()) return R_base_imu_;
  const std::string base = withTfPrefix(names().tf_prefix, names().base);
  const std::string imu = withTfPrefix(names().tf_prefix, message.header.frame_id);
  if (imu.empty() || imu == base) return R_base_imu_ = Eigen::Quaterniond::Identity();
  const auto T_base_imu = tf_.latest(base, imu, toNanoseconds(message.header.stamp));
  if (T_base_imu) return R_base_imu_ = Eigen::Quaterniond(T_base_imu->linear());
  refuse(imu_topic_, "no transform from " + base + " to " + imu +
                         ": publish how the IMU is mounted, for example by `rosrun tf2_ros "
                         "static_transform_publisher 0 0 0 yaw pitch roll " +
                         base + " " + imu + "`");
  return std::nullopt;
}

void ImuInput::publishReady() {
  handOn(ready_);
  for (; without_ < odometry_.withoutAttitude(); ++without_)
    refuse(odometry_topic_,
           "no attitude was at its stamp on " + imu_topic_ +
               " (odometry_mode imu): remap imu to the IMU's topic, give both one clock, and at "
               "least 10 messages a second");
  for (; tilted_ < odometry_.tilted(); ++tilted_) refuse(imu_topic_, kTiltedImuFault);
}

}  // namespace ardrone_vslam
