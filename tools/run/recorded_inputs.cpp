// SPDX-License-Identifier: BSD-3-Clause
#include "run/recorded_inputs.hpp"

#include <iostream>
#include <stdexcept>
#include <utility>

namespace ardrone_vslam {

RecordedOdometry::RecordedOdometry(const SlamConfig& config,
                                   const std::vector<OdometryState>& messages)
    : messages_(messages), adapter_(config.odometry_adapter), buffer_(config.odometry) {}

bool RecordedOdometry::at(std::int64_t stamp_ns, OdometryState& state) {
  using Lookup = OdometryBuffer::Lookup;
  auto lookup = buffer_.at(stamp_ns, state);
  while ((lookup == Lookup::kEmpty || lookup == Lookup::kNotYet) && next_ < messages_.size()) {
    takeNext();
    lookup = buffer_.at(stamp_ns, state);
  }
  return lookup == Lookup::kFound;
}

void RecordedOdometry::takeNext() {
  using Push = OdometryBuffer::Push;
  ready_.clear();
  if (adapter_.push(messages_[next_++], ready_) != Push::kAccepted) ++refused_;
  const bool is_last = next_ == messages_.size();
  if (is_last && adapter_.flush(ready_) != Push::kAccepted) ++refused_;
  for (const OdometryState& state : ready_) {
    if (buffer_.push(state) == Push::kAccepted) {
      speed_.see(state);
    } else {
      ++refused_;
    }
  }
}

RecordedHeights::RecordedHeights(const SlamConfig& config, std::vector<RangeReading> readings)
    : readings_(std::move(readings)), input_(config.height_input, config.odometry.buffer_s) {}

std::optional<double> RecordedHeights::at(const OdometryState& state) {
  const auto isWanted = [&](const RangeReading& next) {  // all of a burst
    const std::int64_t newest_ns = input_.newestStamp_ns();
    return newest_ns < state.stamp_ns || next.stamp_ns == newest_ns;
  };
  while (next_ < readings_.size() && isWanted(readings_[next_])) input_.push(readings_[next_++]);
  return input_.at(state);
}

void checkHeights(const Sequence& sequence, const HeightInputConfig& heights) {
  if (!sequence.ranges().empty()) return;
  if (heights.use_navdata_height) {
    std::cerr << "replay: " << sequence.name()
              << ": holds no heights of an AR.Drone's navdata (use_navdata_height); the scale "
                 "stays the odometry's\n";
  }
  if (heights.use_range) {
    throw std::runtime_error(sequence.name() +
                             ": holds no ranges, which use_range asks for: record the sensor's "
                             "topic (a folder: range.txt), or set use_range to false");
  }
}

}  // namespace ardrone_vslam
