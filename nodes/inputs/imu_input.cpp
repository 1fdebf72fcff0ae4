// SPDX-License-Identifier: BSD-3-Clause
#include "inputs/imu_input.hpp"

#include <boost/make_shared.hpp>
#include <utility>

#include "conversions/conversions.hpp"
#include "conversions/frame_names.hpp"
#include "inputs/frame_matcher.hpp"
#include "with_ros/imu_conversion.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::uint32_t kQueue = 2000;  // 10 s at 200 Hz, in and out

}  // namespace

ImuInput::ImuInput(ros::NodeHandle nh, Frames frames, const ExtrinsicsTf& tf, Take take,
                   Refuse refuse)
    : frames_(std::move(frames)),
      tf_(tf),
      take_(std::move(take)),
      refuse_(std::move(refuse)),
      odometry_pub_(nh.advertise<nav_msgs::Odometry>("observer_odometry", kQueue)),
      imu_sub_(
          nh.subscribe("imu", kQueue, &ImuInput::onImu, this, ros::TransportHints().tcpNoDelay())),
      odometry_sub_(nh.subscribe("odometry", kQueue, &ImuInput::onOdometry, this,
                                 ros::TransportHints().tcpNoDelay())) {}

void ImuInput::onOdometry(const nav_msgs::OdometryConstPtr& message) {
  const auto state = toUnboundedState(*message);
  if (!state.value) return refuse_(odometry_sub_.getTopic(), state.fault);
  if (frames_.odom.empty()) frames_.odom = message->header.frame_id;
  if (frames_.base.empty()) frames_.base = message->child_frame_id;
  if (frames_.base.empty())
    return refuse_(odometry_sub_.getTopic(),
                   "it names no child_frame_id, so that the IMU's mounting is unknown "
                   "(odometry_mode imu): set the parameter base_frame");
  const std::string fault = explain(odometry_.push(*state.value, ready_), *state.value);
  if (!fault.empty()) refuse_(odometry_sub_.getTopic(), fault);
  publishReady();
}

void ImuInput::onImu(const sensor_msgs::ImuConstPtr& message) {
  const auto R_base_imu = mounting(*message);
  if (!R_base_imu) return;
  const auto attitude = toImuAttitude(*message, *R_base_imu);
  if (!attitude.value) return refuse_(imu_sub_.getTopic(), attitude.fault);
  const std::string fault = explain(odometry_.push(*attitude.value, ready_), OdometryState{});
  if (!fault.empty()) refuse_(imu_sub_.getTopic(), fault);
  publishReady();
}

std::optional<Eigen::Quaterniond> ImuInput::mounting(const sensor_msgs::Imu& message) {
  if (R_base_imu_ || frames_.base.empty()) return R_base_imu_;
  const std::string base = withTfPrefix(frames_.tf_prefix, frames_.base);
  const std::string imu = withTfPrefix(frames_.tf_prefix, message.header.frame_id);
  if (imu.empty() || imu == base) return R_base_imu_ = Eigen::Quaterniond::Identity();
  const auto T_base_imu = tf_.latest(base, imu, toNanoseconds(message.header.stamp));
  if (T_base_imu) return R_base_imu_ = Eigen::Quaterniond(T_base_imu->linear());
  refuse_(imu_sub_.getTopic(),
          "no transform from " + base + " to " + imu +
              ": publish how the IMU is mounted, for example by `rosrun tf2_ros "
              "static_transform_publisher 0 0 0 yaw pitch roll " +
              base + " " + imu + "`");
  return std::nullopt;
}

void ImuInput::publishReady() {
  for (const OdometryState& state : ready_) {
    const auto odometry = boost::make_shared<nav_msgs::Odometry>(
        toOdometryMessage(state, withTfPrefix(frames_.tf_prefix, frames_.odom),
                          withTfPrefix(frames_.tf_prefix, frames_.base)));
    odometry_pub_.publish(odometry);
    take_(odometry);
  }
  ready_.clear();
  for (; without_ < odometry_.withoutAttitude(); ++without_)
    refuse_(odometry_sub_.getTopic(),
            "no attitude was at its stamp on " + imu_sub_.getTopic() +
                " (odometry_mode imu): remap imu to the IMU's topic, give both one clock, and at "
                "least 10 messages a second");
  for (; tilted_ < odometry_.tilted(); ++tilted_) refuse_(imu_sub_.getTopic(), kTiltedImuFault);
}

}  // namespace ardrone_vslam
