// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "ardrone_vslam/saved_map.hpp"
#include "window/map_entry.hpp"
#include "window/window_state.hpp"

/// Between the filter's anchors and those of a map that outlives it.
namespace ardrone_vslam {

/// The map as it stands: the poses that landmarks belong to, frames of the window included, with
/// their joint covariance, and the landmarks. Frame and camera are left to who knows them.
/// O(anchors^2 x coordinates + landmarks).
SavedMap savedMapOf(const WindowState& state, const std::vector<Landmark>& landmarks);

/// The other way round.
LoadedAnchors anchorsOf(const SavedMap& map);
/// A loaded map's landmarks as the flight's: its clock ran before the flight began.
/// @param now_ns  stamp of the newest image
std::vector<Landmark> landmarksOf(SavedMap&& map, const LoadedAnchors& anchors, std::int64_t now_ns,
                                  double fix_min_age_s);

}  // namespace ardrone_vslam
