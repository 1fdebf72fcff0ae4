// SPDX-License-Identifier: BSD-3-Clause
#include "freak/freak_pattern.hpp"

#include <algorithm>
#include <cfloat>
#include <cmath>

#include "freak/freak_pairs.hpp"
#include "linear/portable_math.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kPatternScale_px = 22.0;
constexpr int kOctaves = 4;
constexpr float kSmallestSize_px = 7.F;

constexpr int kRings = 8;

// Bit-exactness rests on the order of the floating-point operations here and in field(): do not
// simplify.
constexpr double kOuterRadius = 2.0 / 3.0;
constexpr double kInnerRadius = 2.0 / 24.0;
constexpr double kUnit = (kOuterRadius - kInnerRadius) / 21.0;
constexpr std::array<double, kRings> kRadius{kOuterRadius,
                                             kOuterRadius - 6 * kUnit,
                                             kOuterRadius - 11 * kUnit,
                                             kOuterRadius - 15 * kUnit,
                                             kOuterRadius - 18 * kUnit,
                                             kOuterRadius - 20 * kUnit,
                                             kInnerRadius,
                                             0.0};

double ringSigma(int ring) {
  return kRadius[static_cast<std::size_t>(std::min(ring, kRings - 2))] /
         2.0;  // the centre has the last ring's
}

/// Rounds halves to the even integer. Adding 1.5 * 2^23 leaves no room for a fraction in a float,
/// so the addition itself rounds; exact for |value| < 2^22, and it compiles to two additions where
/// lrint is a call.
int roundHalfEven(float value) {
  static_assert(FLT_EVAL_METHOD == 0, "floats must be rounded to float after every operation");
  constexpr float kShift = 12582912.F;
  return static_cast<int>((value + kShift) - kShift);
}

/// A border is a sum of at most three floats rounded at coordinates below kLargestSide_px = 2^12,
/// where half a unit in the last place is 2^-13: further than 3 * 2^-13 from a half the rounding to
/// an integer cannot be affected.
bool nearHalf(double border_px) {
  const double fraction = border_px - std::floor(border_px);
  return std::abs(fraction - 0.5) <= 3.0 / 8192.0;
}

bool hasBorderNearHalf(const FreakField& f) {
  const double x = f.x_px;
  const double y = f.y_px;
  const double sigma = f.sigma_px;
  return nearHalf(x - sigma) || nearHalf(x + sigma) || nearHalf(y - sigma) || nearHalf(y + sigma);
}

kernels::FreakBox relative(const FreakPixelBox& box, int x_px, int y_px) {
  const auto offset = [](int value_px) { return static_cast<std::int8_t>(value_px); };
  return {offset(box.left_px - x_px), offset(box.top_px - y_px), offset(box.right_px - x_px),
          offset(box.bottom_px - y_px)};
}

bool equal(const kernels::FreakBox& a, const kernels::FreakBox& b) {
  return a.left == b.left && a.top == b.top && a.right == b.right && a.bottom == b.bottom;
}

constexpr int kFirst_px = 24;  ///< no keypoint is closer to the border, and it is even

}  // namespace

FreakPixelBox boxAround(const FreakField& field, int x_px, int y_px) {
  const float x = field.x_px + static_cast<float>(x_px);
  const float y = field.y_px + static_cast<float>(y_px);
  return {roundHalfEven(x - field.sigma_px), roundHalfEven(y - field.sigma_px),
          roundHalfEven(x + field.sigma_px + 1.F), roundHalfEven(y + field.sigma_px + 1.F)};
}

FreakPattern::FreakPattern() {
  const double step = portable::exp(M_LN2 * kOctaves / kFreakScales);
  double factor = 1;
  for (int scale = 0; scale < kFreakScales; ++scale, factor *= step) {
    enlargement_[static_cast<std::size_t>(scale)] = factor;
    border_px_[static_cast<std::size_t>(scale)] =
        static_cast<int>(std::ceil((kRadius[0] + ringSigma(0)) * factor * kPatternScale_px)) + 1;
  }
  for (int orientation = 0; orientation < kFreakOrientations; ++orientation) {
    const double theta = orientation * 2 * M_PI / kFreakOrientations;
    auto& directions = directions_[static_cast<std::size_t>(orientation)];
    for (int k = 0; k < 2 * kFreakPointsPerRing; ++k) {
      const double half_step = k < kFreakPointsPerRing ? 0.0 : M_PI / kFreakPointsPerRing;
      const double alpha =
          (k % kFreakPointsPerRing) * 2 * M_PI / kFreakPointsPerRing + half_step + theta;
      directions[static_cast<std::size_t>(k)] = {portable::cos(alpha), portable::sin(alpha)};
    }
    computeBoxes(orientation);
  }
  std::array<FreakField, kernels::kFreakFields> fields;
  for (int index = 0; index < kernels::kFreakFields; ++index)
    fields[static_cast<std::size_t>(index)] = field(0, 0, index);
  orientation_pairs_ = orientationPairsOf(fields.data());
  comparisons_ = selectedComparisons();
}

FreakField FreakPattern::field(int scale, int orientation, int index) const {
  const int ring = index / kFreakPointsPerRing;
  const int point = index % kFreakPointsPerRing + kFreakPointsPerRing * (ring % 2);
  const Direction& direction =
      directions_[static_cast<std::size_t>(orientation)][static_cast<std::size_t>(point)];
  const double radius = kRadius[static_cast<std::size_t>(ring)];
  const double factor = enlargement_[static_cast<std::size_t>(scale)];
  return {static_cast<float>(radius * direction.cosine * factor * kPatternScale_px),
          static_cast<float>(radius * direction.sine * factor * kPatternScale_px),
          static_cast<float>(ringSigma(ring) * factor * kPatternScale_px)};
}

int FreakPattern::scaleOf(float size_px) {
  if (!(size_px > kSmallestSize_px)) return 0;  // NaN too
  const auto per_log = static_cast<float>(kFreakScales / (portable::log(2.0) * kOctaves));
  const double scale =
      static_cast<float>(portable::log(size_px / kSmallestSize_px)) * per_log + 0.5;
  return static_cast<int>(std::min(scale, kFreakScales - 1.0));
}

void FreakPattern::computeBoxes(int orientation) {
  const auto o = static_cast<std::size_t>(orientation);
  for (int index = 0; index < kernels::kFreakFields; ++index) {
    const FreakField f = field(0, orientation, index);
    if (findExceptions(f)) irregular_[o].push_back({index, f});
  }
  const std::size_t first = rows_.size();
  for (int evenness = 0; evenness < 4; ++evenness) {
    const Row row = rowOf(orientation, kFirst_px + evenness % 2, kFirst_px + evenness / 2);
    std::size_t place = first;
    while (place < rows_.size() && !std::equal(row.begin(), row.end(), rows_[place].begin(), equal))
      ++place;
    if (place == rows_.size()) rows_.push_back(row);
    row_[o][static_cast<std::size_t>(evenness)] = static_cast<std::uint16_t>(place);
  }
}

/// Notes where the box differs from that at the first coordinate of the same evenness.
bool FreakPattern::findExceptions(const FreakField& f) {
  if (!hasBorderNearHalf(f)) return false;
  bool found = false;
  for (int c = kFirst_px; c <= kLargestSide_px - kFirst_px; ++c) {
    const int first = kFirst_px + c % 2;
    if (equal(relative(boxAround(f, c, c), c, c),
              relative(boxAround(f, first, first), first, first)))
      continue;
    exceptional_.set(static_cast<std::size_t>(c));
    found = true;
  }
  return found;
}

FreakPattern::Row FreakPattern::rowOf(int orientation, int x_px, int y_px) const {
  Row row;
  for (int index = 0; index < kernels::kFreakFields; ++index) {
    const FreakPixelBox box = boxAround(field(0, orientation, index), x_px, y_px);
    row[static_cast<std::size_t>(index)] = relative(box, x_px, y_px);
  }
  std::fill(row.begin() + kernels::kFreakFields, row.end(), row[kernels::kFreakFields - 1]);
  return row;
}

}  // namespace ardrone_vslam
