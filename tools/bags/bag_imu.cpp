// SPDX-License-Identifier: BSD-3-Clause
#include <rosbag/view.h>
#include <sensor_msgs/Imu.h>

#include <utility>

#include "bags/bag_poses.hpp"
#include "bags/messages/bag_read_message.hpp"
#include "trajectory/ascent.hpp"
#include "with_ros/imu_conversion.hpp"

namespace ardrone_vslam {
namespace {

// How far the IMU is read ahead of the odometry; less than what it waits for.
constexpr std::int64_t kAhead_ns = ImuOdometry::kLongestGap_ns;

struct Attitudes {
  std::vector<ImuAttitude> all;
  std::size_t refused = 0;
  std::string first_fault;
};

Attitudes readAttitudes(const rosbag::Bag& bag, rosbag::View& view, const std::string& base_frame) {
  Attitudes attitudes;
  std::optional<Eigen::Quaterniond> R_base_imu;
  for (const rosbag::MessageInstance& instance : view) {
    const auto message = readMessage<sensor_msgs::Imu>(instance);
    if (!message) continue;
    if (!R_base_imu) {
      const std::string frame = withoutSlash(message->header.frame_id);
      const bool is_base = frame.empty() || frame == withoutSlash(base_frame);
      R_base_imu = is_base
                       ? Eigen::Quaterniond::Identity()
                       : Eigen::Quaterniond(readExtrinsics(bag, base_frame, frame, "IMU").linear());
    }
    const auto [attitude, fault] = toImuAttitude(*message, *R_base_imu);
    if (attitude) {
      attitudes.all.push_back(*attitude);
    } else if (attitudes.refused++ == 0) {
      attitudes.first_fault = fault;
    }
  }
  return attitudes;
}

}  // namespace

void useImu(const rosbag::Bag& bag, const std::string& topic, BagOdometry& odometry,
            BagFindings& findings) {
  rosbag::View view(bag, rosbag::TopicQuery(topic));
  Attitudes attitudes = readAttitudes(bag, view, odometry.base_frame);
  findings.lose(attitudes.refused, view.size(), topic,
                "messages dropped (the first: " + attitudes.first_fault + ")");
  const std::size_t out_of_order = keepAscent(Ascent::kStrict, attitudes.all);
  findings.lose(out_of_order, view.size(), topic, "messages dropped: stamps must ascend");
  ImuOdometry imu_odometry;
  std::vector<OdometryState> ready;
  auto next = attitudes.all.begin();
  for (const OdometryState& state : odometry.states) {
    imu_odometry.push(state, ready);
    while (next != attitudes.all.end() && next->stamp_ns <= state.stamp_ns + kAhead_ns)
      imu_odometry.push(*next++, ready);
  }
  const std::size_t all = odometry.states.size();
  findings.lose(imu_odometry.tilted(), all, topic,
                std::string("odometry messages dropped: ") + kTiltedImuFault);
  findings.lose(all - ready.size() - imu_odometry.tilted(), all, topic,
                "odometry messages dropped: no attitude was at their stamps; it must come at least "
                "10 times a second");
  odometry.states = std::move(ready);
}

}  // namespace ardrone_vslam
