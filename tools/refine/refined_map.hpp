// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "ardrone_vslam/saved_map.hpp"
#include "refine/track_points.hpp"

namespace ardrone_vslam {

/// The flight's map with what the refinement says: anchors stand on the refined path, landmarks
/// where their points are, or else where they were beside their anchor. The covariance stays the
/// flight's, which is larger than what remains of the errors.
/// @param map  with the landmarks' ids of the flight
/// @param T_map_base_at  poses on the refined path by their stamps [ns]; an anchor without one
/// stays
SavedMap refinedMap(SavedMap map,
                    const std::unordered_map<std::int64_t, Eigen::Isometry3d>& T_map_base_at,
                    const std::vector<TrackPoint3d>& points);

}  // namespace ardrone_vslam
