// SPDX-License-Identifier: BSD-3-Clause
#include "inputs/navdata_input.hpp"

#include <boost/make_shared.hpp>
#include <utility>

#include "conversions/conversions.hpp"
#include "conversions/frame_names.hpp"
#include "inputs/frame_matcher.hpp"
#include "with_ros/navdata_conversion.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::uint32_t kNavdataQueue = 2000;  // 10 s at 200 Hz, in and out

std::string explain(OdometryBuffer::Push answer) {
  if (answer == OdometryBuffer::Push::kOutOfRange)
    return "a velocity, force or height is out of bounds; check its unit";
  return explain(answer, OdometryState{});
}

}  // namespace

// roscpp and rospy compare only the MD5 sums of the two sides, which are equal for
// ardrone_autonomy's type and this package's, whatever their names.
NavdataInput::NavdataInput(ros::NodeHandle nh, Frames frames, Take take, Refuse refuse)
    : frames_(std::move(frames)),
      take_(std::move(take)),
      refuse_(std::move(refuse)),
      odometry_pub_(nh.advertise<nav_msgs::Odometry>("observer_odometry", kNavdataQueue)),
      command_sub_(nh.subscribe("cmd_vel", kNavdataQueue, &NavdataInput::onCommand, this,
                                ros::TransportHints().tcpNoDelay())),
      imu_sub_(nh.subscribe("imu", kNavdataQueue, &NavdataInput::onImu, this,
                            ros::TransportHints().tcpNoDelay())),
      navdata_sub_(nh.subscribe("navdata", kNavdataQueue, &NavdataInput::onNavdata, this,
                                ros::TransportHints().tcpNoDelay())) {
  if (frames_.odom.empty()) frames_.odom = kObserverFrame;
}

void NavdataInput::onNavdata(const NavdataConstPtr& message) {
  const auto reading = toNavdataReading(*message);
  if (!reading.value) return refuse_(navdata_sub_.getTopic(), reading.fault);
  if (frames_.base.empty()) frames_.base = message->header.frame_id;
  const std::string fault = explain(observer_.push(*reading.value, ready_));
  if (!fault.empty()) refuse_(navdata_sub_.getTopic(), fault);
  publishReady();
}

void NavdataInput::onImu(const sensor_msgs::ImuConstPtr& message) {
  const auto imu = toDroneImu(*message);
  if (!imu.value) return refuse_(imu_sub_.getTopic(), imu.fault);
  const std::string fault = explain(observer_.push(*imu.value, ready_));
  if (!fault.empty()) refuse_(imu_sub_.getTopic(), fault);
  publishReady();
}

void NavdataInput::onCommand(const geometry_msgs::TwistConstPtr& message) {
  const std::int64_t now_ns = toNanoseconds(ros::Time::now());
  const std::string fault = explain(observer_.push(toDroneCommand(*message, now_ns)));
  if (!fault.empty()) refuse_(command_sub_.getTopic(), fault);
}

void NavdataInput::publishReady() {
  for (const OdometryState& state : ready_) {
    const auto odometry = boost::make_shared<nav_msgs::Odometry>(
        toOdometryMessage(state, withTfPrefix(frames_.tf_prefix, frames_.odom),
                          withTfPrefix(frames_.tf_prefix, frames_.base)));
    odometry_pub_.publish(odometry);
    take_(odometry);
  }
  ready_.clear();
}

}  // namespace ardrone_vslam
