// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "map_file/map_file_input.hpp"
#include "map_file/section_table.hpp"

namespace ardrone_vslam {

/// Reads the landmarks of a map whose stamp and anchors have been read.
/// @throws MapFileError
void readLandmarks(const MapFileInput& file, const MapSection& section, SavedMap& map);

}  // namespace ardrone_vslam
