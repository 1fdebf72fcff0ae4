// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "pave/pave.hpp"

namespace ardrone_vslam {

/// Which frames of a stream are handed on, and when they were taken.
struct PaveStamps {
  std::vector<std::size_t> frames;      ///< ascending
  std::vector<std::int64_t> stamps_ns;  ///< of these; strictly ascending
  std::size_t restarts = 0;             ///< times the drone's clock began anew
  std::size_t spread_frames = 0;        ///< of a clock that stood still
  std::size_t dropped_frames = 0;       ///< damaged stamps, that others around contradict
};

/// By the drone's clock. Where it begins anew (a drone that was switched on again) stamps go on a
/// second after the last one, as nobody knows how long that took. Where it stands still for most of
/// a run, frames are spread by their numbers, 30 a second unless the run tells another rate.
PaveStamps stampsOf(const std::vector<PaveHeader>& headers);

}  // namespace ardrone_vslam
