// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

#include "window/map_entry.hpp"

namespace ardrone_vslam {

/// About the vertical.
double headingOf(const Eigen::Matrix3d& R);

/// What one image says of the place: where the flight began in the map.
struct PlaceSight {
  MapEntry entry;
  double distance_m = 0;                                    ///< of the landmarks, median
  Eigen::Vector3d camera_flight = Eigen::Vector3d::Zero();  ///< its position
  std::uint32_t anchor_id = 0;                              ///< Landmark::anchor_id of most of them
  std::int64_t last_seen_ns = 0;                            ///< theirs, median
  double cover = 0;  ///< how much of the image is recognised there, see ImageCover
};

/// Whether images apart in time agree on the place, and know enough of it. What only looks like a
/// place is recognised in a part of the image, and not for long as the camera goes on.
class PlaceSights {
 public:
  /// The next image that was looked at; without a sight it says no place.
  /// @param is_here  the flight is known to be in this map; else it may be in a place that is alike
  /// @return whether the flight is found where this image says: so do some others before it that
  /// are recognised as well as a place must be, and all images since the first of them are so in
  /// the mean, where those that do not say the same count as not recognised. A few are enough when
  /// they are recognised well; many, along some way, when half of what they show is
  bool add(const std::optional<PlaceSight>& sight, bool is_here = false);
  void clear() { latest_.clear(); }

 private:
  std::vector<std::optional<PlaceSight>> latest_;
};

}  // namespace ardrone_vslam
