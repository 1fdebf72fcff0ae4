// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "track_sequences.hpp"

namespace ardrone_vslam::bench {

/// How many images lie between the two of a pair.
constexpr std::array<std::size_t, 3> kImagesApart = {1, 3, 10};
constexpr int kFeatures = 600;

/// What a position is said to deviate across its epipolar line, and how far it lies from it.
struct Claim {
  double claimed_px = 0;
  double measured_px = 0;
};

/// Sampson distances of tracks, with their sign [px].
struct Distances {
  std::vector<double> all_px;
  std::vector<double> aligned_px;  ///< of those aligned in both images
  std::vector<Claim> claims;       ///< of those that began in the first of them
};

/// By one way to know the true relative poses.
struct TruthMeasurement {
  std::array<Distances, kImagesApart.size()> apart;
};

/// Of one run of the tracker.
struct TrackMeasurement {
  TruthMeasurement own;       ///< the sequence's truth
  TruthMeasurement refined;   ///< the truth refined on the tracks
  std::size_t continued = 0;  ///< features of tracks that go on
  std::size_t aligned = 0;    ///< those of them that are aligned

  double alignedShare() const {
    return continued > 0 ? static_cast<double>(aligned) / static_cast<double>(continued) : 0;
  }
};

TrackMeasurement measureTracks(const TrueSequence& sequence, bool align_tracks);

}  // namespace ardrone_vslam::bench
