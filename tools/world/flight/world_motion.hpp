// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

namespace ardrone_vslam {

/// From 0 at x = 0 to 1 at x = 1 with three continuous derivatives, so that not even the
/// attitude's rate leaps; constant outside.
inline double smoothStep(double x) {
  if (x <= 0) return 0;
  if (x >= 1) return 1;
  return x * x * x * x * (35 + x * (-84 + x * (70 - 20 * x)));
}

/// Integral of smoothStep from 0 to x.
inline double smoothStepIntegral(double x) {
  if (x <= 0) return 0;
  if (x >= 1) return x - 0.5;
  const double x5 = x * x * x * x * x;
  return x5 * (7 + x * (-14 + x * (10 - 2.5 * x)));
}

inline double wave(double t_s, double frequency_hz, double phase_rad) {
  return std::sin(2 * M_PI * frequency_hz * t_s + phase_rad);
}

/// What the air does to a drone that holds its place: a few centimetres [m].
inline Eigen::Vector3d gusts(double t_s) {
  return {0.025 * wave(t_s, 0.31, 0) + 0.01 * wave(t_s, 0.77, 2),
          0.025 * wave(t_s, 0.27, 1) + 0.01 * wave(t_s, 0.83, 3), 0.02 * wave(t_s, 0.37, 2)};
}

/// A value that rests, moves and rests again: each leg begins where the one before ended.
class Legs {
 public:
  explicit Legs(double first) : first_(first) {}

  /// Moves by `distance` between these times, speeding up and slowing down for `ramp_s` each: half
  /// the time at most.
  Legs& move(double begin_s, double end_s, double distance, double ramp_s) {
    legs_.push_back({begin_s, end_s, distance, std::min(ramp_s, (end_s - begin_s) / 2)});
    return *this;
  }

  double at(double t_s) const {
    double value = first_;
    for (const Leg& leg : legs_) {
      const double cruise_s = leg.end_s - leg.begin_s - leg.ramp_s;
      const double run_s = smoothStepIntegral((t_s - leg.begin_s) / leg.ramp_s) -
                           smoothStepIntegral((t_s - leg.end_s + leg.ramp_s) / leg.ramp_s);
      value += leg.distance * run_s * leg.ramp_s / cruise_s;
    }
    return value;
  }

 private:
  struct Leg {
    double begin_s;
    double end_s;
    double distance;
    double ramp_s;
  };

  double first_;
  std::vector<Leg> legs_;
};

}  // namespace ardrone_vslam
