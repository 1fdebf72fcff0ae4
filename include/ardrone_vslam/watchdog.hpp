// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "ardrone_vslam/parameters.hpp"

namespace ardrone_vslam {

/// How much contradiction ends the trust in the camera, and for how long.
struct WatchdogConfig {
  double watchdog_deviations = 15;
  double watchdog_nis = 8;
  double watchdog_s = 3;
  double watchdog_pause_s = 10;
};

template <class Visitor>
void visitParameters(WatchdogConfig& c, Visitor&& visit) {
  visit(
      ParameterInfo{"watchdog_deviations", "-", 1, 1e6,
                    "constraint filter: trust in the camera ends when it says for watchdog_s that "
                    "the odometry's velocity is wrong by so many velocity_bias_m_s, and no place "
                    "seen before confirms it"},
      c.watchdog_deviations);
  visit(ParameterInfo{"watchdog_nis", "-", 1, 10,
                      "or when the fixes of watchdog_s were further off than they claim (fix_nis)"},
        c.watchdog_nis);
  visit(ParameterInfo{"watchdog_s", "s", 0.1, 1e6, "constraint filter: so long it must last"},
        c.watchdog_s);
  visit(
      ParameterInfo{
          "watchdog_pause_s", "s", 0, 1e6,
          "constraint filter: then the pose is the odometry's for so long; each time it happens "
          "again, twice as long"},
      c.watchdog_pause_s);
}

/// How far camera and odometry contradict each other at one image.
struct Contradiction {
  double bias_deviations = 0;     ///< of the velocity bias that the camera has told the filter
  std::optional<double> fix_nis;  ///< when landmarks of an earlier visit were compared
  bool is_confirmed = false;      ///< such landmarks were in agreement with the pose
};

/// Ends the trust in the camera when it contradicts the odometry for longer than chance or a worse
/// odometry explains: a wrong calibration, a scene that moves, a mirror. Which of the two is wrong
/// nobody knows, but without the camera the pose is never worse than the odometry.
class Watchdog {
 public:
  /// @throws ConfigError listing every parameter out of its range
  explicit Watchdog(const WatchdogConfig& config);

  /// @return whether trust ends with this image
  bool see(std::int64_t stamp_ns, const Contradiction& contradiction);
  /// For watchdog_pause_s after trust ended, and twice as long each time it ends again.
  bool isDistrustful(std::int64_t stamp_ns) const;
  /// Nothing hints at a contradiction: camera and odometry are a good deal closer than the limits.
  bool isCalm() const { return calm_; }

 private:
  WatchdogConfig config_;
  std::optional<std::int64_t> last_ns_;
  double pause_s_;                        // the next one
  std::optional<std::int64_t> until_ns_;  // the end of the pause
  double bias_s_ = 0;                     // how long each has been beyond its limit
  double fixes_s_ = 0;
  bool calm_ = true;
};

}  // namespace ardrone_vslam
