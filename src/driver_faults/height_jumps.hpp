// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>

namespace ardrone_vslam {

/// Tells another floor below (a table) from climbing in an odometry whose z is the measured height:
/// it steps by more in a tenth of a second than the twist's climb explains. The twist's may be zero
/// (firmwares that leave it out): no drone climbs at 1.5 m/s.
class HeightJumpDetector {
 public:
  /// Time within which a step happens.
  static constexpr std::int64_t kWindow_ns = 100'000'000;
  /// A step is at least so high: less is the sensor's noise or a slope.
  static constexpr double kLeast_m = 0.15;
  /// A filtered height needs some time to reach the other floor.
  static constexpr std::int64_t kLongest_ns = 500'000'000;

  /// One height, stamps ascending. @param climb_m  since the one before, by the twist
  /// @return whether a step begins with it
  bool see(std::int64_t stamp_ns, double height_m, double climb_m);
  /// What takes the heights to those above the first floor: by the twist's climb while they step.
  double offset_m() const { return offset_m_; }

 private:
  /// What the height shows beyond the twist's climb.
  struct Excess {
    std::int64_t stamp_ns;
    double excess_m;
  };

  std::deque<Excess> recent_;  // of the window, oldest first
  double climbed_m_ = 0;       // by the twist, since the first height
  double offset_m_ = 0;
  double floor_m_ = 0;  // excess and offset before the step
  std::int64_t until_ns_ = 0;
};

}  // namespace ardrone_vslam
