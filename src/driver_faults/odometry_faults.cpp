// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/odometry_faults.hpp"

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
    case OdometryFault::kTurn:
      return "turned at once, as nothing turns: the heading goes on from where it was; check that "
             "one source alone sends it, and do not restart or reset the driver in flight";
    case OdometryFault::kStartedAgain:
      return "was silent and then began anew at its origin, so that nobody knows where it went "
             "meanwhile: images are compared with the map until one tells the place "
             "(searching_map); do not restart the driver in flight";
    case OdometryFault::kTableStep:
      return "measured its height above another floor than before (a table): z goes on as it was";
  }
  return "";
}

}  // namespace ardrone_vslam
