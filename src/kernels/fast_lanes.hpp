// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "kernels/fast_kernels.hpp"

// FAST-s on many neighbouring pixels at a time, one in each byte of a vector. Included by one file
// for each instruction set, which gives its vectors as the type V, of internal linkage so that no
// code made for one processor can be taken for another's:
//   Bytes, kLanes (a multiple of 4), load, store, broadcast (4 bytes again and again, the low one first), add and
//   subtract (both saturating), min, max, bitOr, any (whether a byte is not 0),
//   forNonZero(bytes, f) (calls f(lane) for each byte that is not 0, ascending),
//   kAnyThroughMemory, storeAny (see listByCompass).
// Nothing but integer arithmetic; equal to the scalar form by its tests.
namespace ardrone_vslam::kernels {

constexpr int kMostColumns = 32768;

/// A row cut into blocks of kLanes pixels. The last one ends where the row ends and so overlaps
/// with the one before it.
template <class V>
class LaneBlocks {
 public:
  using Bytes = typename V::Bytes;

  /// @pre the row has at least kLanes pixels
  LaneBlocks(const FastRow& row, std::ptrdiff_t stride_bytes)
      : row_(row), count_((row.x_end_px - row.x_begin_px + V::kLanes - 1) / V::kLanes) {
    for (int y = -kCircleRadiusPx; y <= kCircleRadiusPx; ++y)
      lines_[y + kCircleRadiusPx] = row.pixels + y * stride_bytes;
    skipped_ = skippedColumns(row.x_begin_px);
    const int overlap = count_ * V::kLanes - (row.x_end_px - row.x_begin_px);
    std::uint8_t done[V::kLanes];
    for (int i = 0; i < V::kLanes; ++i) done[i] = i < overlap ? 255 : 0;
    last_skipped_ = V::bitOr(skippedColumns(xBegin_px(count_ - 1)), V::load(done));
  }

  int count() const { return count_; }
  int xBegin_px(int block) const {
    return block < count_ - 1 ? row_.x_begin_px + block * V::kLanes : row_.x_end_px - V::kLanes;
  }
  Bytes centre(int x) const { return V::load(row_.pixels + x); }
  /// Circle pixel n of each of the block's pixels.
  Bytes circle(int n, int x) const {
    return V::load(lines_[kCircle[n].y_px + kCircleRadiusPx] + x + kCircle[n].x_px);
  }
  /// A pixel that is not to be tested has the threshold 255, at which none is a corner.
  Bytes thresholds(int block, int x) const {
    return V::bitOr(V::load(row_.thresholds + x), block < count_ - 1 ? skipped_ : last_skipped_);
  }

 private:
  Bytes skippedColumns(int x_begin) const {
    std::uint32_t skipped = 0;
    for (int i = 0; i < 4; ++i) {
      if (((row_.columns >> ((x_begin + i) & 3)) & 1U) == 0) skipped |= 0xFFU << (8 * i);
    }
    return V::broadcast(skipped);
  }

  FastRow row_;
  int count_;
  const std::uint8_t* lines_[2 * kCircleRadiusPx + 1];
  Bytes skipped_, last_skipped_;
};

/// What four circle pixels 90 degrees apart say of an arc through them: at a corner `bright` is
/// brighter than the centre + threshold or `dark` darker than the centre - threshold.
template <class V>
struct LaneQuad {
  typename V::Bytes bright, dark;
};

/// Of the four an arc of 12 holds at least three; an arc of 9..11 at least one of each opposite
/// pair.
template <class V, bool kTwelve, int kFirst>
inline LaneQuad<V> quadAt(const LaneBlocks<V>& blocks, int x) {
  const auto a = blocks.circle(kFirst, x);
  const auto b = blocks.circle(kFirst + 8, x);
  const auto c = blocks.circle(kFirst + 4, x);
  const auto d = blocks.circle(kFirst + 12, x);
  const auto low = V::min(V::max(a, b), V::max(c, d));
  const auto high = V::max(V::min(a, b), V::min(c, d));
  if (kTwelve) return {V::min(low, high), V::max(low, high)};  // second smallest, second largest
  return {low, high};
}

/// Lists the blocks in which the initial test leaves a pixel. Which blocks are listed is hardly
/// predictable, so the list is appended to without a branch.
template <class V, bool kTwelve>
int listByCompass(const LaneBlocks<V>& blocks, std::uint16_t* list) {
  const auto open = [&blocks](int block) {
    const int x = blocks.xBegin_px(block);
    const auto centre = blocks.centre(x);
    const auto threshold = blocks.thresholds(block, x);
    const auto quad = quadAt<V, kTwelve, 0>(blocks, x);
    return V::bitOr(V::subtract(quad.bright, V::add(centre, threshold)),
                    V::subtract(V::subtract(centre, threshold), quad.dark));
  };
  int count = 0;
  for (int block = 0; block < blocks.count(); ++block) {
    list[count] = static_cast<std::uint16_t>(block);
    count += static_cast<int>(V::any(open(block)));
  }
  return count;
}

/// What is left of a block after two quads.
enum Left : unsigned { kBrighterLeft = 1, kDarkerLeft = 2 };

/// Keeps the blocks in which the four diagonal pixels leave a pixel, too, as 4 block + Left.
template <class V, bool kTwelve>
int keepByDiagonal(const LaneBlocks<V>& blocks, std::uint16_t* list, int count) {
  int kept = 0;
  for (int i = 0; i < count; ++i) {
    const int block = list[i];
    const int x = blocks.xBegin_px(block);
    const auto centre = blocks.centre(x);
    const auto threshold = blocks.thresholds(block, x);
    const auto compass = quadAt<V, kTwelve, 0>(blocks, x);
    const auto diagonal = quadAt<V, kTwelve, 2>(blocks, x);
    const bool bright =
        V::any(V::subtract(V::min(compass.bright, diagonal.bright), V::add(centre, threshold)));
    const bool dark =
        V::any(V::subtract(V::subtract(centre, threshold), V::max(compass.dark, diagonal.dark)));
    const unsigned left = (bright ? kBrighterLeft : 0U) | (dark ? kDarkerLeft : 0U);
    list[kept] = static_cast<std::uint16_t>(4U * static_cast<unsigned>(block) + left);
    kept += static_cast<int>(left != 0);
  }
  return kept;
}

/// The greatest, over all arcs of kArc, of the least difference in the arc: windows of 2, 4 and 8
/// by doubling. Two arcs that begin at neighbouring pixels have all but their ends in common.
template <class V, int kArc>
inline typename V::Bytes bestArc(const typename V::Bytes* difference) {
  typename V::Bytes two[8];   // [i]: least of pixels 2 i + 1, 2 i + 2
  typename V::Bytes four[8];  // [i]: least of pixels 2 i + 1 .. 2 i + 4
  for (int i = 0; i < 8; ++i)
    two[i] = V::min(difference[2 * i + 1], difference[(2 * i + 2) & 15]);
  for (int i = 0; i < 8; ++i) four[i] = V::min(two[i], two[(i + 1) & 7]);
  typename V::Bytes best{};
  for (int i = 0; i < 8; ++i) {
    auto common = V::min(four[i], four[(i + 2) & 7]);
    if (kArc >= 11) common = V::min(common, two[(i + 4) & 7]);
    if (kArc % 2 == 0) common = V::min(common, difference[(2 * i + kArc - 1) & 15]);
    const auto ends = V::max(difference[2 * i], difference[(2 * i + kArc) & 15]);
    best = V::max(best, V::min(common, ends));
  }
  return best;
}

/// Zero where the pixel is no corner of this polarity, else by how much its best arc exceeds the
/// limit.
template <class V, int kArc>
inline typename V::Bytes brighterExcess(const LaneBlocks<V>& blocks, int x,
                                        typename V::Bytes limit) {
  typename V::Bytes difference[kCircleSize];
  for (int n = 0; n < kCircleSize; ++n) difference[n] = V::subtract(blocks.circle(n, x), limit);
  return bestArc<V, kArc>(difference);
}

template <class V, int kArc>
inline typename V::Bytes darkerExcess(const LaneBlocks<V>& blocks, int x, typename V::Bytes limit) {
  typename V::Bytes difference[kCircleSize];
  for (int n = 0; n < kCircleSize; ++n) difference[n] = V::subtract(limit, blocks.circle(n, x));
  return bestArc<V, kArc>(difference);
}

/// The arcs of the blocks left: hits and scores.
template <class V, int kArc>
int scoreBlocks(const LaneBlocks<V>& blocks, const std::uint16_t* list, int listed,
                const FastHits& hits) {
  const auto one = V::broadcast(0x01010101U);
  int count = 0;
  for (int i = 0; i < listed; ++i) {
    const int block = list[i] / 4;
    const int x = blocks.xBegin_px(block);
    const auto centre = blocks.centre(x);
    const auto threshold = blocks.thresholds(block, x);
    typename V::Bytes excess{};
    if ((list[i] & kBrighterLeft) != 0)
      excess = brighterExcess<V, kArc>(blocks, x, V::add(centre, threshold));
    if ((list[i] & kDarkerLeft) != 0)
      excess = V::max(excess, darkerExcess<V, kArc>(blocks, x, V::subtract(centre, threshold)));
    const auto score = V::where(excess, V::add(excess, V::subtract(threshold, one)));
    // The overlap of the last block has the scores of the block before.
    V::store(hits.scores + x, V::max(score, V::load(hits.scores + x)));
    V::forNonZero(score, [&](int lane) {
      hits.columns[count++] = static_cast<std::uint16_t>(x + lane);
    });
  }
  return count;
}

template <class V, int kArc>
int scanRow(const FastRow& row, const FastCircle& circle, const FastHits& hits) {
  std::uint16_t list[kMostColumns / V::kLanes];
  const LaneBlocks<V> blocks(row, circle.stride_bytes);
  int listed = listByCompass<V, kArc == 12>(blocks, list);
  listed = keepByDiagonal<V, kArc == 12>(blocks, list, listed);
  return scoreBlocks<V, kArc>(blocks, list, listed, hits);
}

/// See fastRowScalar.
template <class V>
int fastRowLanes(const FastRow& row, const FastCircle& circle, const FastHits& hits) {
  if (row.columns == 0) return 0;
  if (row.x_end_px - row.x_begin_px < V::kLanes) return fastRowScalar(row, circle, hits);
  switch (circle.arc_length_px) {
    case 9:
      return scanRow<V, 9>(row, circle, hits);
    case 10:
      return scanRow<V, 10>(row, circle, hits);
    case 11:
      return scanRow<V, 11>(row, circle, hits);
    default:
      return scanRow<V, 12>(row, circle, hits);
  }
}

}  // namespace ardrone_vslam::kernels
