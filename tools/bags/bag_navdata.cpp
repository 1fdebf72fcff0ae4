// SPDX-License-Identifier: BSD-3-Clause
#include <ardrone_vslam/Navdata.h>
#include <geometry_msgs/Twist.h>
#include <rosbag/view.h>
#include <sensor_msgs/Imu.h>

#include "bags/bag_poses.hpp"
#include "bags/messages/bag_messages.hpp"
#include "bags/messages/bag_read_message.hpp"
#include "with_ros/navdata_conversion.hpp"

namespace ardrone_vslam {
namespace {

/// A message into the observer. @return whether it was used
template <class Reading>
bool push(const Checked<Reading>& reading, DroneObserver& observer,
          std::vector<OdometryState>& states) {
  return reading.value && observer.push(*reading.value, states) == OdometryBuffer::Push::kAccepted;
}

/// One of the navdata, the IMU's or the commands. @return false when the observer refused it
bool push(const rosbag::MessageInstance& instance, DroneObserver& observer, BagOdometry& odometry) {
  if (const auto navdata = readMessage<Navdata>(instance)) {
    if (odometry.base_frame.empty()) odometry.base_frame = withoutSlash(navdata->header.frame_id);
    return push(toNavdataReading(*navdata), observer, odometry.states);
  }
  if (const auto imu = readMessage<sensor_msgs::Imu>(instance))
    return push(toDroneImu(*imu), observer, odometry.states);
  const auto command = readMessage<geometry_msgs::Twist>(instance);
  return !command || observer.push(toDroneCommand(*command, toNanoseconds(instance.getTime()))) ==
                         OdometryBuffer::Push::kAccepted;
}

}  // namespace

BagOdometry readNavdata(const rosbag::Bag& bag, const ChosenTopics& topics, BagFindings& findings) {
  BagOdometry odometry;
  DroneObserver observer;
  std::size_t refused = 0;
  std::vector<std::string> wanted{topics.navdata};
  for (const std::string& topic : {topics.imu, topics.command}) {
    if (!topic.empty()) wanted.push_back(topic);
  }
  rosbag::View view(bag, rosbag::TopicQuery(wanted));
  for (const rosbag::MessageInstance& instance : view) {
    if (!push(instance, observer, odometry)) ++refused;
  }
  observer.flush(odometry.states);
  odometry.faults = observer.faults();
  findings.lose(refused, view.size(), topics.navdata + ", IMU and commands",
                "messages dropped: not finite, out of bounds or the stamp goes back");
  if (odometry.states.empty()) findings.warn(topics.navdata, "holds no usable navdata");
  return odometry;
}

std::vector<RangeReading> readNavdataHeights(const rosbag::Bag& bag, const std::string& topic) {
  std::vector<RangeReading> heights;
  if (topic.empty()) return heights;
  rosbag::View view(bag, rosbag::TopicQuery(topic));
  for (const rosbag::MessageInstance& instance : view) {
    const auto navdata = readMessage<Navdata>(instance);
    if (!navdata) continue;
    if (const auto height = toHeightReading(*navdata); height.value)
      heights.push_back(*height.value);
  }
  return heights;
}

}  // namespace ardrone_vslam
