// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "matching/track_order.hpp"
#include "odometry/image_rotation.hpp"

namespace ardrone_vslam {

/// The rays of an image's tracks, kept to be compared with a later image.
struct ImageRays {
  struct Ray {
    std::uint32_t track_id;
    Eigen::Vector3f bearing_cam;
  };
  std::int64_t stamp_ns = 0;
  double focal_length_px = 0;
  std::vector<Ray> rays;  ///< ascending in track id

  /// @param order  kept for its memory
  void take(const ImageFeatures& features, TrackOrder& order);
};

/// The tracks that two images have in common. More than kMostPairs are thinned.
/// @param pairs  set; keeps its memory
void findPairs(const ImageRays& then, const ImageRays& now, std::vector<BearingPair>& pairs);

}  // namespace ardrone_vslam
