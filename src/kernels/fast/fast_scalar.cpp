// SPDX-License-Identifier: BSD-3-Clause
#include "kernels/fast/fast_kernels.hpp"

namespace ardrone_vslam::kernels {
namespace {

enum class Polarity { kBrighter, kDarker };

/// Of four pixels 90 degrees apart an arc of 12 holds at least three; an arc of 9..11 at least two
/// adjacent ones, which is one of each opposite pair.
template <bool kTwelve>
bool fourAllow(bool first, bool opposite_first, bool second, bool opposite_second) {
  if (kTwelve) {
    return (first && opposite_first && (second || opposite_second)) ||
           (second && opposite_second && (first || opposite_first));
  }
  return (first || opposite_first) && (second || opposite_second);
}

/// The full test for one polarity, in the order (3.3), given up as early as possible.
template <Polarity kPolarity>
bool arcConforms(const std::uint8_t* centre, const FastCircle& circle, int limit) {
  NonConformingArc arc(circle.arc_length_px);
  for (const int n : kTestOrder) {
    const int value = centre[circle.offset[n]];
    const bool conforms = kPolarity == Polarity::kBrighter ? value > limit : value < limit;
    if (!conforms && !arc.add(n)) return false;
  }
  return true;
}

/// Initial test, then the full one.
template <bool kTwelve>
bool isCorner(const std::uint8_t* centre, const FastCircle& circle, int threshold) {
  const int bright = *centre + threshold;
  const int dark = *centre - threshold;
  const int p1 = centre[circle.offset[0]];
  const int p9 = centre[circle.offset[8]];
  const int p5 = centre[circle.offset[4]];
  const int p13 = centre[circle.offset[12]];

  if (fourAllow<kTwelve>(p1 > bright, p9 > bright, p5 > bright, p13 > bright) &&
      arcConforms<Polarity::kBrighter>(centre, circle, bright)) {
    return true;
  }
  return fourAllow<kTwelve>(p1 < dark, p9 < dark, p5 < dark, p13 < dark) &&
         arcConforms<Polarity::kDarker>(centre, circle, dark);
}

/// Whether the column is one of those to be tested, as 0 or 1.
int isSampled(const FastRow& row, int x) {
  return static_cast<int>((row.columns >> (x & 3)) & 1U);
}

/// The largest step that meets all columns to be tested from the first of them on.
int columnStep(unsigned columns) {
  const bool one = (columns & (columns - 1)) == 0;
  if (one) return 4;
  return columns == 0x5U || columns == 0xAU ? 2 : 1;
}

/// Lists the columns where circle pixel 1 or 9 is not similar to the centre: every arc of 9 or more
/// holds one of any two opposite pixels. Which columns pass is hardly predictable, so the list is
/// appended to without a branch.
int listByFirstPair(const FastRow& row, const FastCircle& circle, std::uint16_t* list) {
  const int step_px = columnStep(row.columns);
  int x = row.x_begin_px;
  while (isSampled(row, x) == 0) ++x;
  int count = 0;
  for (; x < row.x_end_px; x += step_px) {
    const std::uint8_t* centre = row.pixels + x;
    const int p1 = centre[circle.offset[0]] - *centre;
    const int p9 = centre[circle.offset[8]] - *centre;
    const int highest = p1 > p9 ? p1 : p9;
    const int lowest = p1 > p9 ? p9 : p1;
    const int difference = highest > -lowest ? highest : -lowest;
    list[count] = static_cast<std::uint16_t>(x);
    count += static_cast<int>(difference > row.thresholds[x]) & isSampled(row, x);
  }
  return count;
}

template <bool kTwelve>
int testRow(const FastRow& row, const FastCircle& circle, const FastScores& out) {
  const int candidates = listByFirstPair(row, circle, out.groups);
  int count = 0;
  for (int i = 0; i < candidates; ++i) {
    const std::uint16_t x = out.groups[i];
    if (!isCorner<kTwelve>(row.pixels + x, circle, row.thresholds[x])) continue;
    out.groups[count++] = x;
    out.scores[x] = static_cast<std::uint8_t>(fastScoreScalar(row.pixels + x, circle));
  }
  return count;
}

int higherOf(int a, int b) {
  return a > b ? a : b;
}

struct Smaller {
  std::int16_t operator()(std::int16_t a, std::int16_t b) const { return a < b ? a : b; }
};
struct Larger {
  std::int16_t operator()(std::int16_t a, std::int16_t b) const { return a < b ? b : a; }
};

/// The greatest, over all arcs of s, of the least value in the arc (or the other way round).
/// Windows of 2, 4 and 8 by doubling, then two overlapping windows of 8 make one of s.
template <class Least, class Greatest>
int bestArc(const std::int16_t* twice_around, int arc_length_px, Least least, Greatest greatest) {
  std::int16_t two[31];
  std::int16_t four[29];
  std::int16_t eight[25];
  for (int i = 0; i < 31; ++i) two[i] = least(twice_around[i], twice_around[i + 1]);
  for (int i = 0; i < 29; ++i) four[i] = least(two[i], two[i + 2]);
  for (int i = 0; i < 25; ++i) eight[i] = least(four[i], four[i + 4]);
  std::int16_t best = least(eight[0], eight[arc_length_px - 8]);
  for (int i = 1; i < kCircleSize; ++i) {
    best = greatest(best, least(eight[i], eight[i + arc_length_px - 8]));
  }
  return best;
}

}  // namespace

FastCircle fastCircle(std::ptrdiff_t stride_bytes, int arc_length_px) {
  FastCircle circle{};
  for (int n = 0; n < kCircleSize; ++n)
    circle.offset[n] = kCircle[n].y_px * stride_bytes + kCircle[n].x_px;
  circle.stride_bytes = stride_bytes;
  circle.arc_length_px = arc_length_px;
  return circle;
}

int fastRowScalar(const FastRow& row, const FastCircle& circle, const FastScores& out) {
  if (row.columns == 0) return 0;
  return circle.arc_length_px == 12 ? testRow<true>(row, circle, out)
                                    : testRow<false>(row, circle, out);
}

/// Without branches: which corners are maxima is hardly predictable.
int fastMaximaScalar(const FastNeighbours& rows, std::uint16_t* columns) {
  const int may_exceed = rows.later_may_equal ? 1 : 0;
  int count = 0;
  for (int i = 0; i < rows.group_count; ++i) {
    const std::uint16_t x = rows.groups[i];
    const std::uint8_t* a = rows.above + x;
    const std::uint8_t* c = rows.row + x;
    const std::uint8_t* b = rows.below + x;
    const int earlier = higherOf(higherOf(a[-1], a[0]), higherOf(a[1], c[-1]));
    const int later = higherOf(higherOf(c[1], b[-1]), higherOf(b[0], b[1]));
    columns[count] = x;
    count += static_cast<int>(c[0] > higherOf(earlier, later - may_exceed));
  }
  return count;
}

int fastListScalar(const std::uint8_t*, const std::uint16_t* groups, int group_count,
                   std::uint16_t* columns) {
  for (int i = 0; i < group_count; ++i) columns[i] = groups[i];
  return group_count;
}

bool fastTestScalar(const std::uint8_t* centre, const FastCircle& circle, int threshold) {
  return circle.arc_length_px == 12 ? isCorner<true>(centre, circle, threshold)
                                    : isCorner<false>(centre, circle, threshold);
}

int fastScoreScalar(const std::uint8_t* centre, const FastCircle& circle) {
  std::int16_t difference[2 * kCircleSize];  // positive where the circle is brighter
  for (int n = 0; n < kCircleSize; ++n) {
    difference[n] = static_cast<std::int16_t>(centre[circle.offset[n]] - *centre);
    difference[n + kCircleSize] = difference[n];
  }
  const int brighter = bestArc(difference, circle.arc_length_px, Smaller{}, Larger{});
  const int darker = -bestArc(difference, circle.arc_length_px, Larger{}, Smaller{});
  const int best = brighter > darker ? brighter : darker;
  return best > 0 ? best - 1 : 0;
}

}  // namespace ardrone_vslam::kernels
