// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "ardrone_vslam/features.hpp"

namespace ardrone_vslam::bench {

/// Real maps and what is asked of them: descriptors of the frames of all sequences, and those of
/// the frame after the last one that the map holds.
struct MapDescriptors {
  std::vector<Descriptor> map;
  std::vector<Descriptor> query;  ///< of frames that are not in the map but follow one that is
};

/// @param size  descriptors in the map; computed once for each size
const MapDescriptors& mapDescriptors(std::size_t size);

}  // namespace ardrone_vslam::bench
