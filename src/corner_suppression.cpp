// SPDX-License-Identifier: BSD-3-Clause
#include "corner_suppression.hpp"

#include <algorithm>
#include <cassert>

#include "kernels/kernels.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::uint16_t kScoreMask = 0x00FF;
constexpr std::uint16_t kScored = 0x0100;
constexpr std::uint16_t kClimbed = 0x0200;  ///< a climb has passed here: its end is known

/// The 8 neighbours in raster order: the first half lies before the centre.
constexpr int kNeighbours = 8;
constexpr kernels::CircleOffset kNeighbour[kNeighbours] = {{-1, -1}, {0, -1}, {1, -1}, {-1, 0},
                                                           {1, 0},   {-1, 1}, {0, 1},  {1, 1}};

bool rasterBefore(const Corner& a, const Corner& b) {
  return a.y_px != b.y_px ? a.y_px < b.y_px : a.x_px < b.x_px;
}

}  // namespace

void CornerSuppression::begin(const ImageView& image, int arc_length_px) {
  const int width = image.width_px;
  const int height = image.height_px;
  constexpr int kRing = kernels::kCircleRadiusPx - 1;
  assert(width > 2 * kernels::kCircleRadiusPx && height > 2 * kernels::kCircleRadiusPx &&
         "image without corners");
  image_ = image;
  circle_ = kernels::fastCircle(image.stride_bytes, arc_length_px);
  map_.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);

  // The ring around the testable pixels counts as scored, 0: no climb leaves them, without a test
  // at each step.
  const auto rowAt = [&](int y) { return map_.data() + static_cast<std::ptrdiff_t>(y) * width; };
  for (int y = kRing; y < height - kRing; ++y)
    rowAt(y)[kRing] = rowAt(y)[width - 1 - kRing] = kScored;
  for (int x = kRing; x < width - kRing; ++x)
    rowAt(kRing)[x] = rowAt(height - 1 - kRing)[x] = kScored;
}

void CornerSuppression::climb(std::vector<Corner>& hits, std::vector<Corner>& ends) {
  ends.clear();
  scoreAll(hits);
  for (const Corner& hit : hits) {
    Place place = placeOf(hit);
    // Climbing has no memory: from a pixel passed before it can only lead to the same end.
    bool at_end = false;
    while (!at_end && (*place.entry & kClimbed) == 0) {
      *place.entry |= kClimbed;
      at_end = !step(place);
    }
    if (!at_end) continue;
    ends.push_back({static_cast<std::int16_t>(place.x_px), static_cast<std::int16_t>(place.y_px),
                    static_cast<std::uint8_t>(scoreAt(place))});
  }
  std::sort(ends.begin(), ends.end(), rasterBefore);
}

void CornerSuppression::keepStrictMaxima(std::vector<Corner>& hits, std::vector<Corner>& kept) {
  kept.clear();
  scoreAll(hits);
  for (const Corner& hit : hits) {
    const Place place = placeOf(hit);
    bool strict = true;
    for (int n = 0; n < kNeighbours && strict; ++n) {
      const std::uint16_t entry = *neighbour(place, n).entry;
      strict = (entry & kScored) == 0 || (entry & kScoreMask) < hit.score;
    }
    if (strict) kept.push_back(hit);
  }
}

void CornerSuppression::scoreAll(std::vector<Corner>& hits) {
  for (Corner& hit : hits) hit.score = static_cast<std::uint8_t>(scoreAt(placeOf(hit)));
}

CornerSuppression::Place CornerSuppression::placeOf(const Corner& corner) {
  const std::ptrdiff_t x = corner.x_px;
  const std::ptrdiff_t y = corner.y_px;
  return {image_.data + y * image_.stride_bytes + x, map_.data() + y * image_.width_px + x,
          corner.x_px, corner.y_px};
}

CornerSuppression::Place CornerSuppression::neighbour(const Place& place, int n) const {
  const int dx = kNeighbour[n].x_px;
  const int dy = kNeighbour[n].y_px;
  return {place.pixel + dy * image_.stride_bytes + dx, place.entry + dy * image_.width_px + dx,
          place.x_px + dx, place.y_px + dy};
}

int CornerSuppression::scoreAt(const Place& place) const {
  if ((*place.entry & kScored) == 0) {
    *place.entry = static_cast<std::uint16_t>(
        kScored | kernels::kernelsInUse().fast_score(place.pixel, circle_));
  }
  return *place.entry & kScoreMask;
}

/// Whether the pixel's score is at least `score`. Most neighbours are no corners: the test is
/// cheaper than the score.
bool CornerSuppression::reaches(const Place& place, int score) const {
  if ((*place.entry & kScored) != 0) return (*place.entry & kScoreMask) >= score;
  return kernels::kernelsInUse().fast_test(place.pixel, circle_, score);
}

/// Moves to the highest 8-neighbour. @return false if none is higher
bool CornerSuppression::step(Place& place) const {
  const Place centre = place;
  int required = scoreAt(centre);  // equal score is enough for the neighbours before the centre
  bool moved = false;
  for (int n = 0; n < kNeighbours; ++n) {
    if (n == kNeighbours / 2 && !moved) ++required;
    const Place candidate = neighbour(centre, n);
    if (!reaches(candidate, required)) continue;
    place = candidate;
    moved = true;
    required = scoreAt(candidate) + 1;
  }
  return moved;
}

}  // namespace ardrone_vslam
