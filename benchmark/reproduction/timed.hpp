// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "thread_time.hpp"
#include "trajectory/metrics.hpp"

namespace ardrone_vslam::reproduction {

/// Something that is done to picture i and finds so many features.
struct TimedMethod {
  std::string name;
  std::function<std::size_t(std::size_t picture)> run;
};

struct Timing {
  double time_ms = 0;     ///< of a picture, median of the rounds
  double mean_count = 0;  ///< of features on a picture
};

/// Medians of rounds in which the methods and the pictures take turns; the first round warms up.
inline std::vector<Timing> timeMethods(const std::vector<TimedMethod>& methods,
                                       std::size_t pictures, int rounds) {
  std::vector<Timing> timings(methods.size());
  std::vector<std::vector<double>> times_ms(methods.size());
  for (int round = -1; round < rounds; ++round) {
    for (std::size_t m = 0; m < methods.size(); ++m) {
      std::size_t count = 0;
      const double before = bench::threadTime_ns();
      for (std::size_t i = 0; i < pictures; ++i) count += methods[m].run(i);
      const double time_ms = (bench::threadTime_ns() - before) * 1e-6;
      if (round < 0) continue;
      times_ms[m].push_back(time_ms / static_cast<double>(pictures));
      timings[m].mean_count = static_cast<double>(count) / static_cast<double>(pictures);
    }
  }
  for (std::size_t m = 0; m < methods.size(); ++m) timings[m].time_ms = quantile(times_ms[m], 0.5);
  return timings;
}

}  // namespace ardrone_vslam::reproduction
