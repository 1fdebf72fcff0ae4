// SPDX-License-Identifier: BSD-3-Clause
#include "corners/corner_climb.hpp"

#include <algorithm>
#include <cassert>

#include "corners/sampling_raster.hpp"

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

void CornerClimb::reset(int width_px, int height_px) {
  const int width = map_width_px_ = width_px;
  const int height = map_height_px_ = height_px;
  constexpr int kRing = kernels::kCircleRadiusPx - 1;
  assert(width > 2 * kernels::kCircleRadiusPx && height > 2 * kernels::kCircleRadiusPx &&
         "image without corners");
  map_.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
  written_.reserve(map_.size());  // what is never written to costs no memory

  // The ring around the testable pixels counts as scored, 0: no climb leaves them, without a test
  // at each step.
  const auto rowAt = [&](int y) { return map_.data() + static_cast<std::ptrdiff_t>(y) * width; };
  for (int y = kRing; y < height - kRing; ++y)
    rowAt(y)[kRing] = rowAt(y)[width - 1 - kRing] = kScored;
  for (int x = kRing; x < width - kRing; ++x)
    rowAt(kRing)[x] = rowAt(height - 1 - kRing)[x] = kScored;
}

void CornerClimb::begin(const ImageView& image, int arc_length_px, const Start& start) {
  for (std::uint16_t* entry : written_) *entry = 0;
  written_.clear();
  if (image.width_px != map_width_px_ || image.height_px != map_height_px_)
    reset(image.width_px, image.height_px);
  image_ = image;
  cells_ = start.cells;
  thresholds_ = start.thresholds;
  circle_ = kernels::fastCircle(image.stride_bytes, arc_length_px);
  for (const Corner& corner : start.corners) {
    std::uint16_t* const entry = placeOf(corner).entry;
    *entry = static_cast<std::uint16_t>(kScored | corner.score);
    written_.push_back(entry);
  }
}

void CornerClimb::climb(const ImageView& image, int arc_length_px, const Start& start,
                        std::vector<Corner>& ends) {
  ends.clear();
  begin(image, arc_length_px, start);
  unsigned columns[4];
  for (int y = 0; y < 4; ++y) columns[y] = sampledColumns(y, start.sampling_passes);
  for (const Corner& hit : start.corners) {
    if (((columns[hit.y_px & 3] >> (hit.x_px & 3)) & 1U) == 0) continue;
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

CornerClimb::Place CornerClimb::placeOf(const Corner& corner) {
  const std::ptrdiff_t x = corner.x_px;
  const std::ptrdiff_t y = corner.y_px;
  return {image_.data + y * image_.stride_bytes + x, map_.data() + y * image_.width_px + x,
          corner.x_px, corner.y_px};
}

CornerClimb::Place CornerClimb::neighbour(const Place& place, int n) const {
  // NOLINTNEXTLINE(bugprone-signed-char-misuse): offsets of -1, 0 and 1
  const int dx = kNeighbour[n].x_px, dy = kNeighbour[n].y_px;
  return {place.pixel + dy * image_.stride_bytes + dx, place.entry + dy * image_.width_px + dx,
          place.x_px + dx, place.y_px + dy};
}

int CornerClimb::scoreAt(const Place& place) {
  if ((*place.entry & kScored) == 0) {
    *place.entry = static_cast<std::uint16_t>(kScored | kernels_.fast_score(place.pixel, circle_));
    written_.push_back(place.entry);
  }
  return *place.entry & kScoreMask;
}

/// Whether the pixel's score is at least `score`. Most neighbours are no corners: the test is
/// cheaper than the score.
bool CornerClimb::reaches(const Place& place, int score) const {
  if ((*place.entry & kScored) != 0) return (*place.entry & kScoreMask) >= score;
  if (cells_ != nullptr && score >= thresholds_->at(cells_->cellAt(place.x_px, place.y_px)))
    return false;
  return kernels_.fast_test(place.pixel, circle_, score);
}

/// Moves to the highest 8-neighbour. @return false if none is higher
bool CornerClimb::step(Place& place) {
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
