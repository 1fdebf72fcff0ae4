// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "ardrone_vslam/saved_map.hpp"
#include "window/map_entry.hpp"
#include "window/window_state.hpp"

/// Between the filter's anchors and those of a map that outlives it.
namespace ardrone_vslam {

/// The map as it stands: anchors and frames of the window with their joint covariance, and the
/// landmarks. Frame and camera are left to who knows them. O(coordinates^2 + landmarks / 256),
/// which is a copy.
MapSnapshot snapshotOf(const WindowState& state, const Landmarks& landmarks);

/// The other way round.
LoadedAnchors anchorsOf(const SavedMap& map);
/// A loaded map's landmarks as the flight's: its clock ran before the flight began.
/// @param now_ns  stamp of the newest image
std::vector<Landmark> landmarksOf(SavedMap&& map, const LoadedAnchors& anchors, std::int64_t now_ns,
                                  double fix_min_age_s);

}  // namespace ardrone_vslam
