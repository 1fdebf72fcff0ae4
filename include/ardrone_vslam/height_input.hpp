// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "ardrone_vslam/odometry_buffer.hpp"
#include "ardrone_vslam/odometry_config.hpp"

namespace ardrone_vslam {

/// Whether heights come from readings.
inline bool usesReadings(const HeightInputConfig& config) {
  return config.use_range || config.use_navdata_height;
}

/// What a range sensor under base says, its beam along base's -z. As sensor_msgs/Range: a range
/// outside its own bounds is none.
struct RangeReading {
  std::int64_t stamp_ns = 0;  ///< of the echo
  double range_m = 0;         ///< along the beam, from base
  double min_m = 0;           ///< nearest that the sensor can tell
  double max_m = 0;           ///< and furthest
  bool is_vertical = false;   ///< already the height, whatever the tilt
};

/// The height of base above the floor at image stamps.
class HeightInput {
 public:
  /// Whether a reading is taken, and why not.
  enum class Push {
    kAccepted,
    kOutOfRange,   ///< no echo: not finite, or outside the sensor's own bounds
    kNotAscending  ///< its stamp is not after the one before
  };

  /// @param buffer_s  ranges are kept for so long
  HeightInput(const HeightInputConfig& config, double buffer_s);

  /// Appends a reading; one that is refused changes nothing. Of vertical ones with equal stamps (a
  /// burst) the last counts.
  Push push(const RangeReading& reading);
  /// @param odometry  its stamp is the image's, its attitude turns the range into a height
  /// @return nothing without a range near the stamp, or while base is tilted too much
  std::optional<double> at(const OdometryState& odometry);

  /// Forgets all readings: time began again.
  void clear() { readings_.clear(); }
  /// Of the last reading that was accepted; 0: none.
  std::int64_t newestStamp_ns() const { return readings_.empty() ? 0 : readings_.back().stamp_ns; }
  /// Readings that push() refused.
  std::uint64_t refused() const { return refused_; }
  /// Images without a height because no range was near their stamp.
  std::uint64_t missing() const { return missing_; }
  /// And because base was tilted by more than 20 degrees.
  std::uint64_t tilted() const { return tilted_; }

 private:
  std::optional<double> rangeAt(std::int64_t stamp_ns) const;

  HeightInputConfig config_;
  double buffer_s_;
  std::deque<RangeReading> readings_;  // oldest first
  std::uint64_t refused_ = 0;
  std::uint64_t missing_ = 0;
  std::uint64_t tilted_ = 0;
};

}  // namespace ardrone_vslam
