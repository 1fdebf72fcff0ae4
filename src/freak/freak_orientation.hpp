// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace ardrone_vslam {

/// @return the direction of (sum_x, sum_y) in degrees, -180..180, as FREAK rounds it to float; 0
///   for (0, 0).
float freakAngle_deg(std::int32_t sum_x, std::int32_t sum_y);

/// @param angle_deg  -180..180
/// @return the nearest of the 256 orientations.
int freakOrientation(float angle_deg);

/// @return freakOrientation(freakAngle_deg(sum_x, sum_y)), an order of magnitude faster.
int freakOrientation(std::int32_t sum_x, std::int32_t sum_y);

/// @return the angle in degrees, -180..180.
float degreesWithinHalfTurn(float angle_rad);

}  // namespace ardrone_vslam
