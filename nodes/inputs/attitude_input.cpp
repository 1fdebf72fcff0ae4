// SPDX-License-Identifier: BSD-3-Clause
#include "inputs/attitude_input.hpp"

#include <algorithm>
#include <cmath>

#include "ardrone_vslam/rotation.hpp"
#include "conversions/conversions.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::uint32_t kAttitudeQueue = 200;

}  // namespace

AttitudeInput::AttitudeInput(ros::NodeHandle nh, const NumberOrAuto& image_time_offset_s)
    : extrinsics_(nh),
      image_time_offset_ns_(std::llround(image_time_offset_s.value_or(0) * 1e9)),
      buffer_(OdometryBufferConfig{}),
      topic_(nh.resolveName("attitude")),
      subscriber_(nh.subscribe("attitude", kAttitudeQueue, &AttitudeInput::onAttitude, this)) {}

void AttitudeInput::onAttitude(const nav_msgs::Odometry& message) {
  const auto state = toOdometryState(message);
  if (!state.value) return;  // the mapper, which needs it more, names what is wrong with it
  if (buffer_.push(*state.value) == OdometryBuffer::Push::kBackwardStamp) {
    buffer_.clear();  // a bag plays again
    buffer_.push(*state.value);
  }
  base_frame_ = message.child_frame_id;
}

std::optional<float> AttitudeInput::imageRoll_rad(std::int64_t stamp_ns,
                                                  const std::string& camera_frame) {
  fault_.clear();
  const auto rotation_rad = find(stamp_ns + image_time_offset_ns_, camera_frame);
  if (!rotation_rad) ++images_without_;
  return rotation_rad;
}

std::optional<float> AttitudeInput::find(std::int64_t exposed_ns, const std::string& camera_frame) {
  OdometryState state;
  const std::int64_t newest_ns = buffer_.newestStamp_ns();
  if (buffer_.empty() || exposed_ns - newest_ns > kOldest_ns ||
      buffer_.at(std::min(exposed_ns, newest_ns), state) != OdometryBuffer::Lookup::kFound) {
    fault_ = "no attitude at the image's exposure on " + topic_ +
             ": remap it to the odometry's odometry, or switch use_attitude off";
    return std::nullopt;
  }
  const auto T_base_cam = extrinsics_.find(base_frame_, camera_frame);
  if (!T_base_cam) {
    fault_ = extrinsics_.fault();
    return std::nullopt;
  }
  const auto rotation_rad =
      ardrone_vslam::imageRoll_rad((state.T_odom_base * *T_base_cam).linear());
  if (!rotation_rad) fault_ = "the camera looks up or down: gravity does not tell the image's turn";
  return rotation_rad;
}

}  // namespace ardrone_vslam
