// SPDX-License-Identifier: BSD-3-Clause
#include "attitude_input.hpp"

#include <algorithm>
#include <cmath>

#include "ardrone_vslam/scene_turn.hpp"
#include "conversions.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::uint32_t kQueue = 200;

}  // namespace

AttitudeInput::AttitudeInput(ros::NodeHandle nh, double image_time_offset_s)
    : mounting_(nh),
      image_time_offset_ns_(std::llround(image_time_offset_s * 1e9)),
      buffer_(ObserverBufferConfig{}),
      topic_(nh.resolveName("attitude")),
      subscriber_(nh.subscribe("attitude", kQueue, &AttitudeInput::onAttitude, this)) {}

void AttitudeInput::onAttitude(const nav_msgs::Odometry& message) {
  const auto state = toObserverState(message);
  if (!state.value) return;  // the mapper, which needs it more, names what is wrong with it
  if (buffer_.push(*state.value) == ObserverBuffer::Push::kBackwardStamp) {
    buffer_.clear();  // a bag plays again
    buffer_.push(*state.value);
  }
  base_frame_ = message.child_frame_id;
}

std::optional<float> AttitudeInput::sceneTurn_rad(std::int64_t stamp_ns,
                                                  const std::string& camera_frame) {
  fault_.clear();
  const auto turn_rad = find(stamp_ns + image_time_offset_ns_, camera_frame);
  if (!turn_rad) ++images_without_;
  return turn_rad;
}

std::optional<float> AttitudeInput::find(std::int64_t exposed_ns, const std::string& camera_frame) {
  ObserverState state;
  const std::int64_t newest_ns = buffer_.newestStamp_ns();
  if (buffer_.empty() || exposed_ns - newest_ns > kOldest_ns ||
      buffer_.at(std::min(exposed_ns, newest_ns), state) != ObserverBuffer::Lookup::kFound) {
    fault_ = "no attitude at the image's exposure on " + topic_ +
             ": remap it to the observer's odometry, or switch use_attitude off";
    return std::nullopt;
  }
  const auto T_base_cam = mounting_.find(base_frame_, camera_frame, fault_);
  if (!T_base_cam) return std::nullopt;
  const auto turn_rad = ardrone_vslam::sceneTurn_rad((state.T_odom_base * *T_base_cam).linear());
  if (!turn_rad) fault_ = "the camera looks up or down: gravity does not tell the image's turn";
  return turn_rad;
}

}  // namespace ardrone_vslam
