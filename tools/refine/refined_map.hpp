// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ardrone_vslam/saved_map.hpp"
#include "refine/refinement.hpp"

namespace ardrone_vslam {

/// The flight's map with what the refinement says: anchors stand on the refined path, landmarks
/// where their points are, or else where they were beside their anchor. An anchor that is not in
/// the record, as after its end, moves as the one before it. The anchors' covariance is the
/// refinement's where that has all of them; landmarks keep theirs, beside their anchor. The record
/// goes.
/// @param map  of the record's flight, with the landmarks' ids that it has
SavedMap refinedMap(SavedMap map, const FlightRecord& record, const Refinement& refinement);

}  // namespace ardrone_vslam
