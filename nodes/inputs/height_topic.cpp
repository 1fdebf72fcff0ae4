// SPDX-License-Identifier: BSD-3-Clause
#include "inputs/height_topic.hpp"

#include <utility>

#include "conversions/conversions.hpp"
#include "stamps/stamp_guard.hpp"
#include "with_ros/navdata_conversion.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::uint32_t kHeightQueue = 500;

}  // namespace

HeightTopic::HeightTopic(const HeightInputConfig& config, double buffer_s, Refuse refuse)
    : input_(config, buffer_s), refuse_(std::move(refuse)) {
  if (config.use_range) {
    name_ = "range";
    parameter_ = "use_range";
  } else if (config.use_navdata_height) {
    name_ = "altitude";
    parameter_ = "use_navdata_height";
  }
}

void HeightTopic::subscribe(ros::NodeHandle& nh) {
  if (name_ == "range") {
    subscriber_ = nh.subscribe(name_, kHeightQueue, &HeightTopic::onRange, this);
  } else if (isUsed()) {
    subscriber_ = nh.subscribe(name_, kHeightQueue, &HeightTopic::onAltitude, this);
  }
}

void HeightTopic::onRange(const sensor_msgs::RangeConstPtr& message) {
  take(toRangeReading(*message));
}

void HeightTopic::onAltitude(const NavdataConstPtr& message) {
  take(toHeightReading(*message));
}

void HeightTopic::take(const Checked<RangeReading>& reading) {
  if (!reading.value) {
    ++refused_;
    return refuse_(subscriber_.getTopic(), reading.fault);
  }
  if (input_.newestStamp_ns() - reading.value->stamp_ns >= StampGuard::kRestart_ns) input_.clear();
  // Out of bounds is how the sensor says that there is no echo: counted, no fault.
  switch (input_.push(*reading.value)) {
    case HeightInput::Push::kAccepted:
      return;
    case HeightInput::Push::kNotAscending:
      refuse_(subscriber_.getTopic(), "its stamp is not after the one before; stamps must ascend");
      [[fallthrough]];
    case HeightInput::Push::kOutOfRange:
      ++refused_;
  }
}

std::optional<double> HeightTopic::at(const OdometryState& odometry) {
  const std::uint64_t missing = input_.missing();
  const auto height_m = input_.at(odometry);
  has_height_ = has_height_ || input_.missing() == missing;
  return height_m;
}

void HeightTopic::countSecond() {
  seconds_without_ = has_height_ ? 0 : seconds_without_ + 1;
  has_height_ = false;
}

std::string HeightTopic::missing() const {
  constexpr int kPatience_s = 3;
  if (seconds_without_ < kPatience_s) return {};
  const std::string& topic = subscriber_.getTopic();
  const std::string helps =
      ", or set " + parameter_ + " to false; without it the scale stays unknown";
  if (input_.newestStamp_ns() != 0)
    return topic + ": no " + name_ + " is near the images' stamps: is the sensor alive, and is " +
           "its clock the images'? Mend it" + helps;
  if (refused_ > 0)
    return topic + ": no " + name_ + " could be used yet (" + std::to_string(refused_) +
           " refused: outside of the sensor's bounds, or no stamp): correct the driver" + helps;
  return topic + ": no " + name_ + " has come: remap " + name_ + " to the driver's topic" + helps;
}

}  // namespace ardrone_vslam
