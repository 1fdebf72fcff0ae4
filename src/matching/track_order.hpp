// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "ardrone_vslam/features.hpp"

namespace ardrone_vslam {

/// A feature that belongs to a track.
struct TrackedFeature {
  std::uint32_t track_id = 0;  ///< ImageFeatures::track_id
  std::uint32_t feature = 0;   ///< index into ImageFeatures
};

/// The features of one image ascending in track id, so that two images, or an image and what is
/// known of its tracks, are gone through side by side.
class TrackOrder {
 public:
  /// Sorts the features of an image. O(size log size), allocates only for more than ever before.
  void reset(const ImageFeatures& features);

  /// Of the lowest track id.
  const TrackedFeature* begin() const { return entries_.data(); }
  /// Behind that of the highest.
  const TrackedFeature* end() const { return entries_.data() + entries_.size(); }
  /// @return nullptr when the track does not go through the image. O(log size).
  const TrackedFeature* find(std::uint32_t track_id) const;

 private:
  std::vector<TrackedFeature> entries_;
};

}  // namespace ardrone_vslam
