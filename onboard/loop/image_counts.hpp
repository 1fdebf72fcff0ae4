// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>

namespace ardrone_vslam {

/// What became of the images that were read.
struct ImageCounts {
  std::uint32_t answered = 0;
  std::int64_t all_cost_ns = 0;  ///< processor time of those answered
  std::int64_t most_cost_ns = 0;
  std::uint32_t stamps_refused = 0;
  std::uint32_t without_odometry = 0;
  std::uint32_t out_of_memory = 0;

  void answer(std::int64_t cost_ns) {
    ++answered;
    all_cost_ns += cost_ns;
    most_cost_ns = std::max(most_cost_ns, cost_ns);
  }
  std::uint32_t lost() const { return stamps_refused + without_odometry + out_of_memory; }
};

}  // namespace ardrone_vslam
