// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "ardrone_vslam/landmark.hpp"

namespace ardrone_vslam {

/// Writes the landmarks as replay's landmarks.csv has them, into a file beside it first: there is
/// never half a map. @return a sentence when it cannot be written
std::string writeLandmarks(const std::string& path, const std::vector<Landmark>& map);

/// Whether writeLandmarks() could write there. @return a sentence when not
std::string mapFileFault(const std::string& path);

}  // namespace ardrone_vslam
