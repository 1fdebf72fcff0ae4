// SPDX-License-Identifier: BSD-3-Clause
#include "heights/floor_watch.hpp"

#include <algorithm>
#include <cmath>

namespace ardrone_vslam {
namespace {

constexpr double kSigmas = 5;
constexpr double kSteady_s = 0.3;  // the drone smooths its heights over 0.1 s
constexpr double kSteady_m = 0.05;
constexpr double kLongest_s = 2;  // then accelerometer and velocity foresee no better

}  // namespace

FloorWatch::Answer FloorWatch::see(double time_s, double innovation_m, double sigma_m,
                                   double floor_m) {
  if (std::abs(innovation_m) <= std::max(least_step_m_, kSigmas * sigma_m)) {
    floors_.clear();
    return Answer::kSame;
  }
  if (floors_.empty()) since_s_ = time_s;
  floors_.push_back({time_s, floor_m});
  while (time_s - floors_.front().time_s > kSteady_s) floors_.pop_front();
  const auto [lowest, highest] =
      std::minmax_element(floors_.begin(), floors_.end(),
                          [](const Floor& a, const Floor& b) { return a.height_m < b.height_m; });
  const double waited_s = time_s - since_s_;
  const bool is_steady = waited_s >= kSteady_s && highest->height_m - lowest->height_m <= kSteady_m;
  if (!is_steady && waited_s < kLongest_s) return Answer::kWait;
  floor_m_ = is_steady ? 0.5 * (lowest->height_m + highest->height_m) : floor_m;
  floors_.clear();
  return Answer::kOther;
}

}  // namespace ardrone_vslam
