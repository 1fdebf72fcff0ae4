// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ardrone_vslam/height_input.hpp"
#include "trajectory.hpp"

namespace ardrone_vslam {

/// range.txt of a folder: a line for each reading, stamp [s] and range [m] from base along its -z;
/// nan is a reading without an echo. Empty when there is no such file.
/// @throws std::runtime_error naming file, line and fault
std::vector<RangeReading> readRanges(const std::string& path);
/// @throws std::runtime_error when the file cannot be written
void writeRanges(const std::string& path, const std::vector<RangeReading>& ranges);

/// What a range sensor reads above the floor z = 0, 25 times a second (the AR.Drone's sonar): white
/// noise, no bounds. Equal arguments give equal results. @pre truth not empty
std::vector<RangeReading> simulateRanges(const Trajectory& truth, double noise_m,
                                         std::uint64_t seed);

}  // namespace ardrone_vslam
