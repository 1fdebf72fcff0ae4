// SPDX-License-Identifier: BSD-3-Clause
#include "inputs/navdata_input.hpp"

#include <utility>

#include "conversions/conversions.hpp"
#include "inputs/frame_matcher.hpp"
#include "with_ros/navdata_conversion.hpp"

namespace ardrone_vslam {
namespace {

std::string explain(OdometryBuffer::Push answer) {
  if (answer == OdometryBuffer::Push::kOutOfRange)
    return "a velocity, force or height is out of bounds; check its unit";
  return explain(answer, OdometryState{});
}

}  // namespace

// roscpp and rospy compare only the MD5 sums of the two sides, which are equal for
// ardrone_autonomy's type and this package's, whatever their names.
NavdataInput::NavdataInput(ros::NodeHandle& nh, Frames frames, Take take, Refuse refuse)
    : OdometryMaker(nh, std::move(frames), std::move(take), std::move(refuse)),
      command_topic_(nh.resolveName("cmd_vel")),
      imu_topic_(nh.resolveName("imu")),
      navdata_topic_(nh.resolveName("navdata")) {
  if (names().odom.empty()) names().odom = kObserverFrame;
}

void NavdataInput::subscribe(ros::NodeHandle& nh) {
  const auto hints = ros::TransportHints().tcpNoDelay();
  command_sub_ = nh.subscribe("cmd_vel", kQueue, &NavdataInput::onCommand, this, hints);
  imu_sub_ = nh.subscribe("imu", kQueue, &NavdataInput::onImu, this, hints);
  navdata_sub_ = nh.subscribe("navdata", kQueue, &NavdataInput::onNavdata, this, hints);
}

void NavdataInput::onNavdata(const NavdataConstPtr& message) {
  const auto reading = toNavdataReading(*message);
  if (!reading.value) return refuse(navdata_topic_, reading.fault);
  if (names().base.empty()) names().base = message->header.frame_id;
  const std::string fault = explain(observer_.push(*reading.value, ready_));
  if (!fault.empty()) refuse(navdata_topic_, fault);
  handOn(ready_);
}

void NavdataInput::onImu(const sensor_msgs::ImuConstPtr& message) {
  const auto imu = toDroneImu(*message);
  if (!imu.value) return refuse(imu_topic_, imu.fault);
  const std::string fault = explain(observer_.push(*imu.value, ready_));
  if (!fault.empty()) refuse(imu_topic_, fault);
  handOn(ready_);
}

void NavdataInput::onCommand(const geometry_msgs::TwistConstPtr& message) {
  const std::int64_t now_ns = toNanoseconds(ros::Time::now());
  const std::string fault = explain(observer_.push(toDroneCommand(*message, now_ns)));
  if (!fault.empty()) refuse(command_topic_, fault);
}

}  // namespace ardrone_vslam
