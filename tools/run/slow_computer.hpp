// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include "sequences/sequence.hpp"

namespace ardrone_vslam {

/// How long a computer is busy with an image: its measured time, or a fixed one, times a factor.
struct ComputerSpeed {
  std::optional<double> image_ms;
  double cpu_factor = 1;
};

/// A computer that is busy when images arrive: as the tracker nodelet with `queue_size: 1` it keeps
/// the newest, which it takes as soon as it is free, and loses those before. An image arrives at
/// its stamp.
class SlowComputer {
 public:
  explicit SlowComputer(const ComputerSpeed& speed) : speed_(speed) {}

  /// @param index  of the image that is done
  /// @param measured_ms  what it cost here
  /// @return the image that comes next; the sequence's size when there is none
  std::size_t next(const Sequence& sequence, std::size_t index, double measured_ms);
  int dropped() const { return dropped_; }

 private:
  ComputerSpeed speed_;
  std::int64_t free_ns_ = std::numeric_limits<std::int64_t>::min();
  int dropped_ = 0;
};

}  // namespace ardrone_vslam
