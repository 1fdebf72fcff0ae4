// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "ardrone_vslam/features.hpp"

namespace ardrone_vslam {

/// First track id of a tracker that starts at this wall time. A mapper outlives a tracker that is
/// started again and knows landmarks by their track ids, so the new one must not give the same.
/// One id for each 16.384 us: more than any tracker uses up, so the ids of a later start lie beyond
/// those of an earlier one; they come round after 19.5 h.
inline std::uint32_t firstTrackId(std::uint64_t wall_time_ns) {
  const auto id = static_cast<std::uint32_t>(wall_time_ns >> 14);
  return id == kNoTrack ? 1 : id;
}

}  // namespace ardrone_vslam
