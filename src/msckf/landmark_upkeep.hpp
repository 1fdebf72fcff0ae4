// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "ardrone_vslam/landmark.hpp"
#include "ardrone_vslam/msckf_config.hpp"
#include "map/association.hpp"
#include "map/landmark_map.hpp"
#include "map_update/map_update.hpp"
#include "matching/frame_view.hpp"
#include "msckf/re_anchoring.hpp"
#include "msckf/track_update.hpp"

/// What becomes of the map's landmarks at a frame of the MSCKF. The views are from the corrected
/// position, at the predicted attitude.
namespace ardrone_vslam {

/// A used track's point, seen from this view, as a landmark without id.
Landmark landmarkOf(const UsedTrack& used, const FrameView& view);

/// Whether its point is known well enough, beside its distance, to become a landmark.
bool isWellKnown(const UsedTrack& one, const FrameView& view);

/// Gives a young landmark its track's newer point, where that is clearly better.
void renew(const UsedTrack& one, const FrameView& view, const MsckfConfig& config,
           const Landmark& landmark, LandmarkMap& map);

/// Takes landmarks along with their anchors. O(landmarks).
void applyCorrections(const std::vector<AnchorCorrection>& corrections, const FrameView& view,
                      LandmarkMap& map);

/// Where the map is not to change: matched landmarks only learn which track is theirs.
void followTracks(const FrameView& view, const std::vector<Association>& matches, LandmarkMap& map);

/// Landmarks that this frame speaks against: not found though others of their place and part of the
/// image are, or off an accepted fix. The latter are no longer counted as seen in it.
/// @param verdicts  of the matches
/// @param is_relocated  the frame's fix is a relocation: most matches are simply wrong
/// @return indices into map.all()
std::vector<int> takeFailed(const AssociationResult& matches,
                            const std::vector<Association>& trusted,
                            const std::vector<ObservationVerdict>& verdicts, bool is_relocated,
                            const FrameView& view, LandmarkMap& map);

}  // namespace ardrone_vslam
