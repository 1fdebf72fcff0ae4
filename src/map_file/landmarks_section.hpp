// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "ardrone_vslam/landmark.hpp"
#include "map_file/little_endian.hpp"
#include "map_file/map_file_input.hpp"
#include "map_file/section_table.hpp"

namespace ardrone_vslam {

constexpr std::size_t kLandmarkRecord = 160;  ///< bytes of a landmark in a file

/// Why a landmark is neither written nor read, judged by the numbers as the file has them.
/// @param anchors  how many the map has
/// @return nullptr where nothing is wrong
const char* landmarkFault(const Landmark& landmark, std::size_t anchors);

/// Appends kLandmarkRecord bytes. @pre it has no landmarkFault
/// @param stamp_ns  of the map
void writeLandmark(const Landmark& landmark, std::int64_t stamp_ns, ByteWriter& out);

/// Reads the landmarks of a map whose stamp and anchors have been read.
/// @throws MapFileError
void readLandmarks(const MapFileInput& file, const MapSection& section, SavedMap& map);

}  // namespace ardrone_vslam
