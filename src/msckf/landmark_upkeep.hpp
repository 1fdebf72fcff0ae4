// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "ardrone_vslam/landmark.hpp"
#include "ardrone_vslam/msckf_config.hpp"
#include "ardrone_vslam/setup_watch.hpp"
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

/// Landmarks that this frame speaks against: not found though others of their place are, or off an
/// accepted fix. The latter are no longer counted as seen in it.
/// @param verdicts  of the matches
/// @param is_relocated  the frame's fix is a relocation: most matches are simply wrong
/// @return indices into map.all()
std::vector<int> takeFailed(const AssociationResult& matches,
                            const std::vector<Association>& trusted,
                            const std::vector<ObservationVerdict>& verdicts, bool is_relocated,
                            LandmarkMap& map);

/// Takes landmarks back: what was made of images that a wrong set-up explains is wrong as well.
class UnconfirmedLandmarks {
 public:
  /// What is known of the set-up at the next frame.
  void heed(const SetupFinding& finding) { setup_ = finding; }
  /// While the camera is not used, drops those since it was last confirmed. @return how many went
  int judge(LandmarkMap& map);
  /// A new landmark, made of the image of this stamp.
  void add(std::int64_t stamp_ns) { newest_ns_ = stamp_ns; }
  /// A landmark of a loaded map, which this flight's set-up did not make. Their ids follow each
  /// other.
  void addLoaded(std::uint32_t id) {
    if (first_loaded_id_ == 0) first_loaded_id_ = id;
    last_loaded_id_ = id;
  }

 private:
  bool isLoaded(std::uint32_t id) const {
    return first_loaded_id_ != 0 && id >= first_loaded_id_ && id <= last_loaded_id_;
  }
  SetupFinding setup_;
  std::uint32_t first_loaded_id_ = 0;  // 0: none
  std::uint32_t last_loaded_id_ = 0;
  std::int64_t newest_ns_ = 0;     // a landmark's image: ids come round
  std::int64_t confirmed_ns_ = 0;  // the newest when the set-up was last confirmed
};

}  // namespace ardrone_vslam
