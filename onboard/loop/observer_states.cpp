// SPDX-License-Identifier: BSD-3-Clause
#include "loop/observer_states.hpp"

namespace ardrone_vslam {

ObserverStates::ObserverStates(const SlamConfig& config)
    : adapter_(config.odometry_adapter),
      buffer_(config.odometry),
      heights_(config.height_input, config.odometry.buffer_s) {
  ready_.reserve(64);
}

void ObserverStates::clear() {
  buffer_.clear();
  heights_.clear();
}

bool ObserverStates::take(OdometryBuffer::Push answer) {
  bool is_good = answer == OdometryBuffer::Push::kAccepted;
  for (const OdometryState& state : ready_)
    is_good = buffer_.push(state) == OdometryBuffer::Push::kAccepted && is_good;
  return is_good;
}

bool ObserverStates::add(const OdometryState& message) {
  const StampGuard::Answer stamp = stamps_.check(message.stamp_ns);
  if (stamp == StampGuard::Answer::kAlone) return false;
  if (stamp == StampGuard::Answer::kRestart) clear();
  if (message.height_m) {
    RangeReading reading;
    reading.stamp_ns = message.stamp_ns;
    reading.range_m = *message.height_m;
    reading.max_m = kFarthestOdometry_m;
    reading.is_vertical = true;
    heights_.push(reading);
  }
  ready_.clear();
  return take(adapter_.push(message, ready_));
}

void ObserverStates::end() {
  ready_.clear();
  take(adapter_.flush(ready_));
  is_over_ = true;
}

OdometryBuffer::Lookup ObserverStates::at(std::int64_t exposed_ns, std::int64_t image_ns,
                                          OdometryState& state) {
  const OdometryBuffer::Lookup lookup = buffer_.at(exposed_ns, state);
  if (lookup != OdometryBuffer::Lookup::kFound) return lookup;
  state.height_m = heights_.at(state);
  state.stamp_ns = image_ns;  // the pose keeps the image's stamp
  return lookup;
}

}  // namespace ardrone_vslam
