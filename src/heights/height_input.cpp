// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/height_input.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "linear/portable_math.hpp"
#include "linear/scalars.hpp"

namespace ardrone_vslam {
namespace {

// A sonar's beam then meets a wall, or the floor beside the drone.
constexpr double kMostTilt_deg = 20;
// Readings are interpolated at the image's stamp across no longer a hole; at their end the nearest
// one counts for as long.
constexpr double kLongestGap_s = 0.1;

}  // namespace

HeightInput::HeightInput(const HeightInputConfig& config, double buffer_s)
    : config_(config), buffer_s_(buffer_s) {
  validate(config);
}

HeightInput::Push HeightInput::push(const RangeReading& reading) {
  const bool is_in_range = std::isfinite(reading.range_m) && reading.range_m > 0 &&
                           reading.range_m >= reading.min_m && reading.range_m <= reading.max_m;
  const bool is_of_burst =
      reading.is_vertical && !readings_.empty() && reading.stamp_ns == readings_.back().stamp_ns;
  if (is_of_burst && is_in_range) readings_.pop_back();
  const bool is_ascending = readings_.empty() || reading.stamp_ns > readings_.back().stamp_ns;
  if (!is_in_range || !is_ascending) {
    ++refused_;
    return is_in_range ? Push::kNotAscending : Push::kOutOfRange;
  }
  readings_.push_back(reading);
  while (seconds(reading.stamp_ns - readings_.front().stamp_ns) > buffer_s_) readings_.pop_front();
  return Push::kAccepted;
}

std::optional<double> HeightInput::at(const OdometryState& odometry) {
  if (!usesReadings(config_)) {
    if (config_.known_height_m > 0) return config_.known_height_m;
    return std::nullopt;
  }
  const auto range_m = rangeAt(odometry.stamp_ns);
  if (!range_m) {
    ++missing_;
    return std::nullopt;
  }
  const double cosine = odometry.T_odom_base.linear()(2, 2);  // between the two z axes
  if (!(cosine >= portable::cos(kMostTilt_deg * M_PI / 180))) {
    ++tilted_;
    return std::nullopt;
  }
  return readings_.back().is_vertical ? *range_m : *range_m * cosine;
}

std::optional<double> HeightInput::rangeAt(std::int64_t stamp_ns) const {
  const auto after =
      std::lower_bound(readings_.begin(), readings_.end(), stamp_ns,
                       [](const RangeReading& r, std::int64_t t) { return r.stamp_ns < t; });
  const auto isNear = [&](const RangeReading& r) {
    return seconds(std::abs(r.stamp_ns - stamp_ns)) <= kLongestGap_s;
  };
  if (after == readings_.end() || after == readings_.begin()) {
    if (readings_.empty()) return std::nullopt;
    const RangeReading& only = after == readings_.end() ? readings_.back() : *after;
    if (!isNear(only)) return std::nullopt;
    return only.range_m;
  }
  const RangeReading& before = *std::prev(after);
  const double gap_s = seconds(after->stamp_ns - before.stamp_ns);
  if (gap_s <= kLongestGap_s) {
    const double share = seconds(stamp_ns - before.stamp_ns) / gap_s;
    return before.range_m + share * (after->range_m - before.range_m);
  }
  if (after->stamp_ns == stamp_ns) return after->range_m;
  return std::nullopt;
}

}  // namespace ardrone_vslam
