// SPDX-License-Identifier: BSD-3-Clause
#include "map/feature_map.hpp"

#include <algorithm>

namespace ardrone_vslam {

void FeatureMap::add(const MapFeature& feature) {
  const int stale = indexOfTrack(feature.track_id);
  if (stale >= 0) features_[static_cast<std::size_t>(stale)].track_id = kNoTrack;
  if (feature.track_id != kNoTrack) index_of_track_[feature.track_id] = features_.size();
  features_.push_back(feature);
  removed_.push_back(false);
}

void FeatureMap::remove(std::size_t index) {
  removed_[index] = true;
}

int FeatureMap::indexOfTrack(std::uint32_t track_id) const {
  const auto entry = index_of_track_.find(track_id);
  return entry == index_of_track_.end() || removed_[entry->second]
             ? -1
             : static_cast<int>(entry->second);
}

int FeatureMap::compact(std::int64_t now_ns) {
  const auto alive = static_cast<std::size_t>(std::count(removed_.begin(), removed_.end(), false));
  const auto cap = static_cast<std::size_t>(config_.max_map_features);
  std::size_t surplus = alive > cap ? alive - cap : 0;
  const std::int64_t oldest_kept_ns =
      now_ns - static_cast<std::int64_t>(config_.max_feature_age_s * 1e9);
  int dropped = 0;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < features_.size(); ++i) {
    if (removed_[i]) continue;
    const bool above_cap = surplus > 0;  // entries are in the order they came
    if (above_cap) --surplus;
    if (above_cap || features_[i].stamp_ns < oldest_kept_ns) {
      ++dropped;
      continue;
    }
    if (kept != i) features_[kept] = features_[i];
    ++kept;
  }
  features_.resize(kept);
  removed_.assign(kept, false);
  index_of_track_.clear();
  for (std::size_t i = 0; i < kept; ++i) {
    if (features_[i].track_id != kNoTrack) index_of_track_[features_[i].track_id] = i;
  }
  return dropped;
}

}  // namespace ardrone_vslam
