// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "ardrone_vslam/landmark.hpp"
#include "map_file/little_endian.hpp"

namespace ardrone_vslam {

constexpr std::size_t kLandmarkRecord = 160;  ///< bytes of a landmark in a file

/// Why a landmark is neither written nor read, judged by the numbers as the file has them.
/// @param anchors  how many the map has
/// @return nullptr where nothing is wrong
const char* landmarkFault(const Landmark& landmark, std::size_t anchors);

/// Appends kLandmarkRecord bytes. @pre it has no landmarkFault
/// @param stamp_ns  of the map
void writeLandmark(const Landmark& landmark, std::int64_t stamp_ns, ByteWriter& out);

/// Fills in what is in a file; the rest stays as it is. A count that is too large for a Landmark
/// becomes -1, which is a fault.
void readLandmark(std::int64_t stamp_ns, ByteReader& in, Landmark& landmark);

}  // namespace ardrone_vslam
