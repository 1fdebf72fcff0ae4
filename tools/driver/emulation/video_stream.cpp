// SPDX-License-Identifier: BSD-3-Clause
#include "driver/emulation/video_stream.hpp"

#include <ros/console.h>

#include <cmath>
#include <utility>

#include "simulation/random_source.hpp"

namespace ardrone_vslam {
namespace {

constexpr const char* kBottom = "bottom";
constexpr double kVideoWarnPeriod_s = 5;

}  // namespace

VideoStream::VideoStream(const World& world, DriverLink& link, const FakeDriverConfig& config)
    : link_(link),
      front_(config.camera == kBottom ? "front" : config.camera),
      is_bottom_(config.camera == kBottom),
      rate_hz_(config.rate),
      seed_(RandomSource::mix(static_cast<std::uint64_t>(config.seed))),
      camera_(world, CameraEffects{}, {front_, kBottom}) {}

std::string VideoStream::activeCamera() const {
  return is_bottom_ ? kBottom : front_;
}

void VideoStream::select(bool bottom) {
  if (bottom == is_bottom_) return;
  is_bottom_ = bottom;
  ROS_INFO_STREAM("the " << activeCamera() << " camera streams");
}

void VideoStream::expose(const DroneMoment& moment, std::int64_t now_ns,
                         std::int64_t since_begin_ns, const DriverTopics& topics) {
  const auto since_begin_s = static_cast<double>(since_begin_ns) * 1e-9;
  const double exposed_s = static_cast<double>(exposed_) / rate_hz_;
  if (exposed_s > since_begin_s + 1e-9) return;
  const std::int64_t index = exposed_++;
  const std::int64_t delay_ns = link_.videoDelay_ns();
  if (!topics.isWatched()) return;
  // The exposure was up to a step ago.
  const double ago_s = since_begin_s - exposed_s;
  CameraShot shot;
  shot.camera = activeCamera();
  const CameraPath path = pathThrough(moment.state, cameraNamed(shot.camera).T_body_cam);
  shot.stamp_ns = now_ns - std::llround(ago_s * 1e9) + delay_ns;
  shot.t_s = moment.t_s;
  shot.motion = [path, ago_s](double since_stamp_s) { return path(since_stamp_s - ago_s); };
  shot.seed = seed_ + static_cast<std::uint64_t>(index);
  camera_.shoot(std::move(shot));
}

void VideoStream::publishArrived(std::int64_t now_ns, DriverTopics& topics) {
  while (const auto shot = camera_.take(now_ns)) topics.publish(*shot);
}

void VideoStream::diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using diagnostic_msgs::DiagnosticStatus;
  const LiveCamera::Counts counts = camera_.counts();
  if (counts.lost > lost_before_) {
    status.summary(DiagnosticStatus::WARN,
                   "this computer is too slow to render all images: lower rate, or shutter");
    ROS_WARN_STREAM_THROTTLE(kVideoWarnPeriod_s,
                             counts.lost << " images were not rendered in time and are left out ("
                                         << counts.rendered << " were): lower rate, or shutter");
  } else {
    status.summary(DiagnosticStatus::OK, "in time");
  }
  status.add("images rendered", counts.rendered);
  status.add("images not rendered in time", counts.lost);
  status.add("milliseconds for the latest image", counts.render_ms);
  lost_before_ = counts.lost;
}

}  // namespace ardrone_vslam
