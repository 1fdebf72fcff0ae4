// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/odometry_faults.hpp"

#include <cmath>

#include "odometry/message_pair.hpp"

namespace ardrone_vslam {

void add(const OdometryFaultCounts& counts, OdometryFaultCounts& sum) {
  for (std::size_t i = 0; i < kOdometryFaultCount; ++i) sum[i] += counts[i];
}

bool isWorthWarning(OdometryFault fault) {
  return fault != OdometryFault::kNoCovariance && fault != OdometryFault::kTableStep;
}

const char* explain(OdometryFault fault) {
  switch (fault) {
    case OdometryFault::kNoCovariance:
      return "gives no position covariance: its noise is that of walk_m_per_sqrt_m and _s (thesis: "
             "odometry_noise_m_per_sqrt_m and _s)";
    case OdometryFault::kJump:
      return "jumped by kilometres and stayed there (ardrone_autonomy does when it is started in "
             "flight): the position goes on from where it was";
    case OdometryFault::kReset:
      return "began anew at its origin: the position goes on from where it was; do not restart or "
             "reset the driver in flight";
    case OdometryFault::kRestart:
      return "has stamps that began anew (a bag plays again, the clock was set back): it is taken "
             "as a new flight";
    case OdometryFault::kWholeMetres:
      return "has heights in whole metres (ardrone_autonomy before 1.4.1): update the driver; "
             "until "
             "then odometry_mode twist smooths them, and height is known to a metre only";
    case OdometryFault::kBurst:
      return "sends several messages with one stamp: they are spread over the gap before, and come "
             "one stamp later for it; set realtime_navdata in the driver, as its launch file does";
    case OdometryFault::kHole:
      return "was silent for more than a second, and the way flown in that time is lost: check the "
             "radio link and `rostopic hz`";
    case OdometryFault::kNoTwist:
      return "has a twist of zeros although its pose moves: set odometry_mode to pose";
    case OdometryFault::kTableStep:
      return "measured its height above another floor than before (a table): z goes on as it was";
  }
  return "";
}

bool WholeMetresWatch::see(double height_m, double climb_m) {
  constexpr double kClimb_m = 0.05;  // a twist that drifts at rest is told by the height
  if (height_m != std::round(height_m)) {
    *this = {};
    return false;
  }
  const bool is_step = count_ > 0 && height_m != last_m_;
  if (count_ < kFewest) ++count_;
  last_m_ = height_m;
  climbed_m_ = is_step ? 0 : climbed_m_ + climb_m;
  if (count_ < kFewest) return false;
  // At 0 it stands on the floor, whatever its twist says.
  if (is_step || (height_m != 0 && std::abs(climbed_m_) > kClimb_m)) is_whole_ = true;
  return is_step;
}

bool MissingTwistWatch::see(bool is_twist_zero, double way_m) {
  constexpr double kMost_m = 1;
  if (!is_twist_zero) {
    without_twist_m_ = 0;
  } else if (way_m < kJump_m) {
    without_twist_m_ += way_m;
  }
  if (without_twist_m_ < kMost_m) return false;
  without_twist_m_ = 0;
  return true;
}

}  // namespace ardrone_vslam
