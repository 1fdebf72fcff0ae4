// SPDX-License-Identifier: BSD-3-Clause
#include "freak/freak_orientation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>

#include "freak/freak_pattern.hpp"
#include "linear/portable_math.hpp"

namespace ardrone_vslam {
namespace {

/// Arc tangent of 0..1 in orientations, 0..32, to 0.0005 (Abramowitz and Stegun 4.4.49: 1e-5 rad).
float roughArcTangent(float t) {
  constexpr auto kPerRad = static_cast<float>(kFreakOrientations / (2.0 * M_PI));
  const float s = t * t;
  const float series =
      0.999866F + s * (-0.3302995F + s * (0.180141F + s * (-0.085133F + s * 0.0208351F)));
  return kPerRad * t * series;
}

}  // namespace

float freakAngle_deg(std::int32_t sum_x, std::int32_t sum_y) {
  const double y = sum_y;
  const double x = sum_x;
  return static_cast<float>(portable::atan2(y, x) * (180.0 / M_PI));
}

int freakOrientation(float angle_deg) {
  const double index = kFreakOrientations * static_cast<double>(angle_deg) / 360.0;  // -128..128
  return static_cast<int>(std::lrint(index)) & (kFreakOrientations - 1);
}

int freakOrientation(std::int32_t sum_x, std::int32_t sum_y) {
  const auto x = static_cast<float>(std::abs(sum_x));
  const auto y = static_cast<float>(std::abs(sum_y));
  const float largest = std::max(std::max(x, y), 1.F);  // not 0 / 0
  // In which eighth of the circle it lies cannot be predicted: a table instead of branches.
  const auto eighth = static_cast<std::size_t>(y > x) + 2 * static_cast<std::size_t>(sum_x < 0) +
                      4 * static_cast<std::size_t>(sum_y < 0);
  constexpr std::array<float, 8> kStart{0.F, 64.F, 128.F, 64.F, 256.F, 192.F, 128.F, 192.F};
  constexpr std::array<float, 8> kSense{1.F, -1.F, -1.F, 1.F, -1.F, 1.F, 1.F, -1.F};
  const float index = kStart[eighth] + kSense[eighth] * roughArcTangent(std::min(x, y) / largest);
  // Close to the middle between two orientations only the exact angle tells them apart.
  const int nearest = static_cast<int>(index + 0.5F);  // NOLINT(bugprone-incorrect-roundings)
  constexpr float kDoubtful = 0.002F;
  if (std::abs(index - static_cast<float>(nearest)) > 0.5F - kDoubtful)
    return freakOrientation(freakAngle_deg(sum_x, sum_y));
  return nearest & (kFreakOrientations - 1);
}

float degreesWithinHalfTurn(float angle_rad) {
  return static_cast<float>(std::remainder(static_cast<double>(angle_rad), 2.0 * M_PI) *
                            (180.0 / M_PI));
}

}  // namespace ardrone_vslam
