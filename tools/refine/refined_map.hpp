// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ardrone_vslam/saved_map.hpp"
#include "refine/refinement.hpp"

namespace ardrone_vslam {

/// The flight's map with what the refinement says: anchors stand on the refined path, landmarks
/// where their points are, or else where they were beside their anchor. What came after the last
/// keyframe moves as that did. The anchors' covariance is the refinement's, where it was asked for;
/// landmarks keep theirs, beside their anchor. The record goes.
/// @param map  of the record's flight, with the landmarks' ids that it has
SavedMap refinedMap(SavedMap map, const FlightRecord& record, const Refinement& refinement);

}  // namespace ardrone_vslam
