// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>

#include "ardrone_vslam/features.hpp"
#include "ardrone_vslam/parameters.hpp"

namespace ardrone_vslam {

/// How far a track may go between two images, and how alike its descriptors must be.
struct FrameTrackerConfig {
  double search_radius_px = 80.0;
  int max_hamming_bits = 100;
  double ratio = 0.85;
};

template <class Visitor>
void visitParameters(FrameTrackerConfig& c, Visitor&& visit) {
  visit(ParameterInfo{"track_search_radius_px", "px", 1.0, 4096.0,
                      "how far a feature may move between two frames"},
        c.search_radius_px);
  visit(ParameterInfo{"track_max_hamming_bits", "bits", 0, 512,
                      "largest descriptor distance within a track"},
        c.max_hamming_bits);
  visit(ParameterInfo{"track_ratio", "-", 0.0, 1.0,
                      "best distance must be below ratio times the second best; 1 is off"},
        c.ratio);
}

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
  void assign(ImageFeatures& features);

  /// The id that the next new track gets: given to no track yet (until 2^32 of them have been).
  std::uint32_t nextTrackId() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ardrone_vslam
