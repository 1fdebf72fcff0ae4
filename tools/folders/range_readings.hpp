// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "ardrone_vslam/height_input.hpp"
#include "trajectory/trajectory.hpp"

namespace ardrone_vslam {

/// range.txt of a folder: a line for each reading, stamp [s] and range [m] from base along its -z;
/// nan is a reading without an echo. Empty when there is no such file.
/// @throws std::runtime_error naming file, line and fault
std::vector<RangeReading> readRanges(const std::string& path);
/// @throws std::runtime_error when the file cannot be written
void writeRanges(const std::string& path, const std::vector<RangeReading>& ranges);

/// Range from base down along its -z; nothing without an echo.
using RangeAt = std::function<std::optional<double>(const Eigen::Isometry3d& T_map_base,
                                                    std::int64_t stamp_ns)>;

/// What a range sensor reads 25 times a second (the AR.Drone's sonar): white noise, no bounds; nan
/// without an echo. Equal arguments give equal results. @pre truth not empty
std::vector<RangeReading> simulateRanges(const Trajectory& truth, const RangeAt& range_m,
                                         double noise_m, std::uint64_t seed);

}  // namespace ardrone_vslam
