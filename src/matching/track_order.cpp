// SPDX-License-Identifier: BSD-3-Clause
#include "matching/track_order.hpp"

#include <algorithm>

namespace ardrone_vslam {

void TrackOrder::reset(const ImageFeatures& features) {
  entries_.clear();
  for (std::size_t i = 0; i < features.size(); ++i) {
    if (features.track_id[i] != kNoTrack)
      entries_.push_back({features.track_id[i], static_cast<std::uint32_t>(i)});
  }
  std::sort(entries_.begin(), entries_.end(), [](const TrackedFeature& a, const TrackedFeature& b) {
    return a.track_id != b.track_id ? a.track_id < b.track_id : a.feature < b.feature;
  });
}

const TrackedFeature* TrackOrder::find(std::uint32_t track_id) const {
  const auto* entry = std::lower_bound(
      begin(), end(), track_id,
      [](const TrackedFeature& one, std::uint32_t id) { return one.track_id < id; });
  return entry != end() && entry->track_id == track_id ? entry : nullptr;
}

}  // namespace ardrone_vslam
