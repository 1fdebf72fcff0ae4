// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "ardrone_vslam/features.hpp"
#include "ardrone_vslam/tracker_config.hpp"

namespace ardrone_vslam {

/// Gives features of the present frame the track ids of the frame before (thesis 4.1.4).
class FrameTracker {
 public:
  /// @param first_track_id  of the first new track, the following ones count up; not kNoTrack
  /// (asserted). Who keeps tracks beyond a tracker's life gives the next one its nextTrackId().
  explicit FrameTracker(const FrameTrackerConfig& config, std::uint32_t first_track_id = 1);
  ~FrameTracker();

  /// Makes room for so many features in images of this size, so that assign() does not allocate.
  void reserve(std::size_t features, int width_px, int height_px);

  /// Fills `track_id` and `age_frames`; pixels and descriptors must be there. Mutual best matches
  /// within the search radius carry on their track, all others begin a new one. Keeps a copy for
  /// the next frame.
  /// @return for each feature the place, in the frame before, of the one whose track it carries on;
  ///   -1: it begins one. Valid until the next call
  const std::vector<int>& assign(ImageFeatures& features);

  /// The id that the next new track gets: given to no track yet (until 2^32 of them have been).
  std::uint32_t nextTrackId() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ardrone_vslam
