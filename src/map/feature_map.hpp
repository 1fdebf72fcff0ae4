// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "ardrone_vslam/features.hpp"
#include "ardrone_vslam/slam_config.hpp"
#include "map/triangulation.hpp"

namespace ardrone_vslam {

/// Something seen once, without depth yet: waits for a second view from elsewhere.
struct MapFeature {
  std::uint32_t track_id = kNoTrack;  ///< by which it is found again; kNoTrack: by descriptor alone
  Ray ray;                            ///< from where and in which direction it was seen
  double elevation =
      0;  ///< tangent of the ray's elevation; used in 2-D mode, where rays have no height
  double position_variance_m2 = 0;  ///< of ray.origin_map, per axis, at that time
  std::int64_t stamp_ns = 0;        ///< of the image that saw it
  Descriptor descriptor;            ///< as seen there
};

/// Storage of features in the order they came, with look-up by track.
class FeatureMap {
 public:
  explicit FeatureMap(const FeatureMapConfig& config) : config_(config) {}

  /// Stores a feature. An entry of the same track that is there already loses its track for good
  /// (the track left its point: a mismatch) and waits for a match by descriptor.
  void add(const MapFeature& feature);
  /// Marks an entry for removal; indices stay valid until `compact`.
  void remove(std::size_t index);
  /// Drops what was removed, is too old or above the cap (the oldest first). O(size). @return
  /// entries aged or capped out
  int compact(std::int64_t now_ns);

  /// Index of the entry that follows a track, -1 when there is none.
  int indexOfTrack(std::uint32_t track_id) const;
  /// Whether remove() was called for it since the last compact().
  bool isRemoved(std::size_t index) const { return removed_[index]; }
  /// In the order they came, with those marked as removed.
  const std::vector<MapFeature>& all() const { return features_; }
  /// Number of entries in all().
  std::size_t size() const { return features_.size(); }

 private:
  FeatureMapConfig config_;
  std::vector<MapFeature> features_;
  std::vector<bool> removed_;
  std::unordered_map<std::uint32_t, std::size_t> index_of_track_;
};

}  // namespace ardrone_vslam
