// SPDX-License-Identifier: BSD-3-Clause
#include "inputs/frame_matcher.hpp"

#include <algorithm>

#include "conversions/conversions.hpp"

namespace ardrone_vslam {

FrameMatcher::FrameMatcher(const OdometryBufferConfig& config, double wait_s,
                           const ImageClock& clock)
    : buffer_(config), wait_s_(wait_s), clock_(clock) {}

void FrameMatcher::addFeatures(const FeaturesConstPtr& features, double now_s) {
  waiting_.push_back({features, now_s});
}

std::optional<FrameMatcher::Frame> FrameMatcher::next(
    double now_s, const std::function<bool(const Features&)>& can_use) {
  using Lookup = OdometryBuffer::Lookup;
  while (!waiting_.empty()) {
    const bool is_late = now_s - waiting_.front().since_s > wait_s_;
    Frame frame{waiting_.front().features, {}};
    const std::int64_t stamp_ns = toNanoseconds(frame.features->header.stamp);
    const Lookup answer = buffer_.at(clock_.exposed_ns(stamp_ns), frame.odometry);
    if (answer == Lookup::kFound) {
      const bool is_usable = can_use(*frame.features);
      if (!is_usable && !is_late) return std::nullopt;
      waiting_.pop_front();
      if (is_usable) return frame;
      ++dropped_held_;
      continue;
    }
    const bool may_come = answer == Lookup::kEmpty || answer == Lookup::kNotYet;
    if (may_come && !is_late) return std::nullopt;
    waiting_.pop_front();
    last_miss_ = answer;
    ++dropped_no_odometry_;
  }
  return std::nullopt;
}

bool FrameMatcher::forgetAfter(std::int64_t stamp_ns) {
  const bool is_old_odometry = buffer_.newestStamp_ns() > stamp_ns;
  if (is_old_odometry) buffer_.clear();
  const std::size_t count = waiting_.size();
  waiting_.erase(std::remove_if(waiting_.begin(), waiting_.end(),
                                [stamp_ns](const Waiting& frame) {
                                  return toNanoseconds(frame.features->header.stamp) > stamp_ns;
                                }),
                 waiting_.end());
  dropped_no_odometry_ += count - waiting_.size();
  return is_old_odometry || waiting_.size() < count;
}

std::string explain(OdometryBuffer::Lookup miss, const std::string& odometry_topic) {
  using Lookup = OdometryBuffer::Lookup;
  switch (miss) {
    case Lookup::kFound:
      return {};
    case Lookup::kEmpty:
      return "no odometry has come on " + odometry_topic +
             " (nav_msgs/Odometry): start the driver, or remap `odometry` to its topic "
             "(launch files: odometry:=TOPIC; see `rostopic list`)";
    case Lookup::kNotYet:
      return "the odometry on " + odometry_topic +
             " ends before the images' stamps: it has stopped, its clock is behind the camera's, "
             "or it comes later than odometry_wait_s";
    case Lookup::kTooOld:
      return "the images' stamps are before all odometry kept from " + odometry_topic +
             ": the clocks differ, or images come later than odometry_buffer_s";
    case Lookup::kGap:
      return "the odometry on " + odometry_topic +
             " has a hole longer than half a second at the images' stamps; check its rate "
             "(`rostopic hz`)";
  }
  return {};
}

std::string explain(OdometryBuffer::Push answer, const OdometryState& message) {
  switch (answer) {
    case OdometryBuffer::Push::kAccepted:
      return {};
    case OdometryBuffer::Push::kNotFinite:
      return "it is not finite";
    case OdometryBuffer::Push::kOutOfRange: {
      const std::string fault = rangeFault(message);
      return fault.empty() ? "its position jumped by kilometres" : fault;
    }
    case OdometryBuffer::Push::kDuplicateStamp:
      return "its stamp is that of the message before";
    case OdometryBuffer::Push::kBackwardStamp:
      return "its stamp is before that of the message before; stamps must ascend";
  }
  return {};
}

}  // namespace ardrone_vslam
