// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "track_measurement.hpp"

namespace ardrone_vslam::bench {

/// What the tables show of one sequence.
struct MeasuredSequence {
  std::string name;
  std::size_t images = 0;
  TrackMeasurement whole_pixels;
  TrackMeasurement aligned;
};

/// The page's part, as markdown, to standard output.
void printTracks(const std::vector<MeasuredSequence>& sequences);

}  // namespace ardrone_vslam::bench
