// SPDX-License-Identifier: BSD-3-Clause
#include "bags/bag_poses.hpp"

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <nav_msgs/Odometry.h>
#include <rosbag/view.h>
#include <sensor_msgs/Range.h>
#include <tf2/buffer_core.h>
#include <tf2/exceptions.h>
#include <tf2_msgs/TFMessage.h>

#include <map>
#include <stdexcept>
#include <utility>

#include "ardrone_vslam/odometry_buffer.hpp"
#include "ardrone_vslam/slam.hpp"
#include "bags/messages/bag_messages.hpp"
#include "bags/messages/bag_read_message.hpp"
#include "trajectory/ascent.hpp"

namespace ardrone_vslam {
namespace {

/// Stamp and pose of any of the types that may tell the truth.
struct TruthPose {
  std::int64_t stamp_ns;
  std::optional<Eigen::Isometry3d> T_map_base;
};

constexpr const char* kNotInOrder =
    "messages dropped: the stamp goes back, or far ahead of those that follow; correct the clock "
    "of its source";

std::optional<TruthPose> toTruthPose(const rosbag::MessageInstance& instance) {
  if (const auto pose = readMessage<geometry_msgs::PoseStamped>(instance)) {
    return TruthPose{toNanoseconds(pose->header.stamp), toIsometry(pose->pose).value};
  }
  if (const auto pose = readMessage<geometry_msgs::PoseWithCovarianceStamped>(instance)) {
    return TruthPose{toNanoseconds(pose->header.stamp), toIsometry(pose->pose.pose).value};
  }
  if (const auto odometry = readMessage<nav_msgs::Odometry>(instance)) {
    return TruthPose{toNanoseconds(odometry->header.stamp), toIsometry(odometry->pose.pose).value};
  }
  return std::nullopt;
}

/// Says once that the odometry's covariance counts as not given, and why, as the mapper nodelet
/// does.
void warnOfCovariance(const std::vector<OdometryState>& states, const std::string& topic,
                      BagFindings& findings) {
  for (const OdometryState& state : states) {
    const std::string fault = covarianceFault(state);
    if (fault.empty()) continue;
    findings.warn(topic, fault);
    return;
  }
}

bool standsStill(const std::vector<OdometryState>& states) {
  for (const OdometryState& state : states) {
    if (state.T_odom_base.matrix() != states.front().T_odom_base.matrix()) return false;
  }
  return states.size() > 1;
}

}  // namespace

std::string withoutSlash(const std::string& frame) {
  return !frame.empty() && frame[0] == '/' ? frame.substr(1) : frame;
}

BagOdometry readOdometry(const rosbag::Bag& bag, const std::string& topic, BagFindings& findings) {
  BagOdometry odometry;
  if (topic.empty()) return odometry;
  std::size_t refused = 0;
  std::string first_fault;
  std::size_t too_far = 0;
  rosbag::View view(bag, rosbag::TopicQuery(topic));
  for (const rosbag::MessageInstance& instance : view) {
    const auto message = readMessage<nav_msgs::Odometry>(instance);
    if (!message) continue;
    if (odometry.base_frame.empty()) odometry.base_frame = withoutSlash(message->child_frame_id);
    const auto [state, fault] = toUnboundedState(*message);
    if (!state) {
      if (refused++ == 0) first_fault = fault;
    } else if (isBeyondAllJumps(*state)) {
      ++too_far;
    } else {
      odometry.states.push_back(*state);
    }
  }
  const std::size_t out_of_order = keepAscent(Ascent::kMayRepeat, odometry.states);
  findings.lose(refused, view.size(), topic,
                "messages dropped (the first: " + first_fault + "); correct the odometry's source");
  findings.lose(
      too_far, view.size(), topic,
      "messages dropped: " + std::string(kTooFarFault) + "; correct the odometry's source");
  findings.lose(out_of_order, view.size(), topic, kNotInOrder);
  warnOfCovariance(odometry.states, topic, findings);
  if (odometry.states.empty())
    findings.warn(topic, "holds no usable odometry; record a working odometry");
  if (standsStill(odometry.states)) {
    findings.warn(topic, "all " + std::to_string(odometry.states.size()) +
                             " poses are equal (zero odometry); check that the odometry runs");
  }
  return odometry;
}

std::vector<RangeReading> readRanges(const rosbag::Bag& bag, const std::string& topic,
                                     BagFindings& findings) {
  std::vector<RangeReading> ranges;
  if (topic.empty()) return ranges;
  rosbag::View view(bag, rosbag::TopicQuery(topic));
  for (const rosbag::MessageInstance& instance : view) {
    const auto message = readMessage<sensor_msgs::Range>(instance);
    if (!message) continue;
    ranges.push_back({toNanoseconds(message->header.stamp), message->range, message->min_range,
                      message->max_range});
  }
  const std::size_t out_of_order = keepAscent(Ascent::kMayRepeat, ranges);
  findings.lose(out_of_order, view.size(), topic, kNotInOrder);
  return ranges;
}

Trajectory readTruth(const rosbag::Bag& bag, const std::string& topic, BagFindings& findings) {
  if (topic.empty()) return {};
  std::vector<StampedPose> truth;
  std::size_t not_finite = 0;
  std::size_t too_far = 0;
  rosbag::View view(bag, rosbag::TopicQuery(topic));
  for (const rosbag::MessageInstance& instance : view) {
    const auto pose = toTruthPose(instance);
    if (!pose) continue;
    if (!pose->T_map_base) {
      ++not_finite;
    } else if (isTooFar(pose->T_map_base->translation())) {
      ++too_far;
    } else {
      truth.push_back({pose->stamp_ns, *pose->T_map_base});
    }
  }
  const std::size_t out_of_order = keepAscent(Ascent::kStrict, truth);
  findings.lose(not_finite, view.size(), topic,
                "messages dropped: the pose is not finite or its quaternion is not a unit");
  findings.lose(too_far, view.size(), topic, std::string("messages dropped: ") + kTooFarFault);
  // Motion capture repeats stamps: nothing is lost by that.
  if (out_of_order > 0) findings.warn(topic, std::to_string(out_of_order) + " " + kNotInOrder);
  return Trajectory(std::move(truth));
}

Eigen::Isometry3d readExtrinsics(const rosbag::Bag& bag, const std::string& base_frame,
                                 const std::string& sensor_frame, const std::string& sensor) {
  // It is fixed to base: its last transform holds for all time, static or not.
  tf2::BufferCore buffer;
  std::map<std::string, std::string> parents;
  rosbag::View view(bag, rosbag::TopicQuery(std::vector<std::string>{"/tf", "/tf_static"}));
  for (const rosbag::MessageInstance& instance : view) {
    const auto message = readMessage<tf2_msgs::TFMessage>(instance);
    if (!message) continue;
    for (const auto& transform : message->transforms) {
      const std::string child = withoutSlash(transform.child_frame_id);
      parents[child] = withoutSlash(transform.header.frame_id);
      // tf2 would print some lines for each.
      if (toIsometry(transform.transform).value) buffer.setTransform(transform, "bag", true);
    }
  }
  std::string base = withoutSlash(base_frame);
  if (base.empty()) base = parents[sensor_frame];
  try {
    const auto message = buffer.lookupTransform(base, sensor_frame, ros::Time(0));
    if (const auto T_base_sensor = toIsometry(message.transform).value) {
      const std::string fault = extrinsicsFault(*T_base_sensor);
      if (fault.empty()) return *T_base_sensor;
      throw std::runtime_error(bag.getFileName() + ": tf from the base frame '" + base +
                               "' to the " + sensor + " frame '" + sensor_frame + "': " + fault);
    }
  } catch (const tf2::TransformException&) {
  }
  throw std::runtime_error(
      bag.getFileName() + ": tf has no transform from the base frame '" + base + "' to the " +
      sensor + " frame '" + sensor_frame +
      "'; record /tf_static (tf2_ros static_transform_publisher base -> " + sensor +
      "), or name the frames by --base-frame and, of a camera, --camera-frame");
}

}  // namespace ardrone_vslam
