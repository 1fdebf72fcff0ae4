// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "kernels/fast/fast_kernels.hpp"

// FAST-s on many neighbouring pixels at a time, one in each byte of a vector. Included by one file
// for each instruction set, which gives its vectors as the type V, of internal linkage so that no
// code made for one processor can be taken for another's:
//   Bytes, kLanes (a multiple of 4), load, loadOnce (for what several instructions use), store,
//   broadcast (4 bytes again and again, the low one first), add and subtract (both saturating),
//   min, max, bitOr, where (the second argument's bytes where the first one's are not 0, else 0),
//   any (whether a byte is not 0),
//   append (the columns x + i of the bytes i that are not 0; may write 4 entries too many),
//   kFlagsThroughMemory, Flag, storeAny (a flag that is not 0 if any()).
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
    skipped_ = skippedColumns(xBegin_px(0));
    last_skipped_ = skippedColumns(xBegin_px(count_ - 1));
  }

  int count() const { return count_; }
  int xBegin_px(int block) const {
    return block < count_ - 1 ? row_.x_begin_px + block * V::kLanes : row_.x_end_px - V::kLanes;
  }
  Bytes centre(int x) const { return V::load(row_.pixels + x); }
  /// Circle pixel n of each of the block's pixels.
  Bytes circle(int n, int x) const {
    return V::loadOnce(lines_[kCircle[n].y_px + kCircleRadiusPx] + x + kCircle[n].x_px);
  }
  /// A pixel that is not to be tested has the threshold 255, at which none is a corner.
  Bytes thresholds(int block, int x) const {
    return V::bitOr(V::load(row_.thresholds + x), block < count_ - 1 ? skipped_ : last_skipped_);
  }

 private:
  Bytes skippedColumns(int x_begin) const {
    const unsigned skipped = ~row_.columns & 0xFU;
    const unsigned from_begin = ((skipped | (skipped << 4)) >> (x_begin & 3)) & 0xFU;
    return V::broadcast(((from_begin * 0x00204081U) & 0x01010101U) * 0xFFU);  // a byte for each bit
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

/// Not 0 where the initial test leaves a pixel.
template <class V, bool kTwelve>
inline typename V::Bytes leftByCompass(const LaneBlocks<V>& blocks, int block) {
  const int x = blocks.xBegin_px(block);
  const auto centre = blocks.centre(x);
  const auto threshold = blocks.thresholds(block, x);
  const auto quad = quadAt<V, kTwelve, 0>(blocks, x);
  return V::bitOr(V::subtract(quad.bright, V::add(centre, threshold)),
                  V::subtract(V::subtract(centre, threshold), quad.dark));
}

/// Lists the blocks in which the initial test leaves a pixel. Which blocks are listed is hardly
/// predictable, so this list and the next are appended to without a branch.
template <class V, bool kTwelve>
int listByCompass(const LaneBlocks<V>& blocks, std::uint16_t* list) {
  int count = 0;
  const auto append = [&](int block, bool any) {
    list[count] = static_cast<std::uint16_t>(block);
    count += static_cast<int>(any);
  };
  if (V::kFlagsThroughMemory) {
    typename V::Flag flags[kMostColumns / V::kLanes];
    for (int block = 0; block < blocks.count(); ++block)
      V::storeAny(leftByCompass<V, kTwelve>(blocks, block), flags + block);
    for (int block = 0; block < blocks.count(); ++block) append(block, flags[block] != 0);
    return count;
  }
  int block = 0;
  for (; block + 1 < blocks.count(); block += 2) {  // two at a time: a third faster
    const auto left = leftByCompass<V, kTwelve>(blocks, block);
    const auto next_left = leftByCompass<V, kTwelve>(blocks, block + 1);
    append(block, V::any(left));
    append(block + 1, V::any(next_left));
  }
  if (block < blocks.count()) append(block, V::any(leftByCompass<V, kTwelve>(blocks, block)));
  return count;
}

/// Blocks in which two quads leave pixels.
template <class V>
struct LaneLists {
  static constexpr int kMost = kMostColumns / V::kLanes;
  std::uint16_t brighter[kMost];
  std::uint16_t darker[kMost];
  std::uint16_t either[kMost];
  int brighter_count = 0;
  int darker_count = 0;
  int either_count = 0;
};

/// Keeps the blocks in which the four diagonal pixels leave a pixel, too.
/// @param lists  its `either` holds the blocks left by the initial test
template <class V, bool kTwelve>
void keepByDiagonal(const LaneBlocks<V>& blocks, LaneLists<V>& lists) {
  int brighter_count = 0;
  int darker_count = 0;
  int either_count = 0;
  for (int i = 0; i < lists.either_count; ++i) {
    const std::uint16_t block = lists.either[i];
    const int x = blocks.xBegin_px(block);
    const auto centre = blocks.centre(x);
    const auto threshold = blocks.thresholds(block, x);
    const auto compass = quadAt<V, kTwelve, 0>(blocks, x);
    const auto diagonal = quadAt<V, kTwelve, 2>(blocks, x);
    const int brighter = static_cast<int>(
        V::any(V::subtract(V::min(compass.bright, diagonal.bright), V::add(centre, threshold))));
    const int darker = static_cast<int>(
        V::any(V::subtract(V::subtract(centre, threshold), V::max(compass.dark, diagonal.dark))));
    lists.brighter[brighter_count] = block;
    lists.darker[darker_count] = block;
    lists.either[either_count] = block;
    brighter_count += brighter;
    darker_count += darker;
    either_count += brighter | darker;
  }
  lists.brighter_count = brighter_count;
  lists.darker_count = darker_count;
  lists.either_count = either_count;
}

/// The greatest, over all arcs of kArc, of the least difference in the arc: windows of 2, 4 and 8
/// by doubling. Two arcs that begin at neighbouring pixels have all but their ends in common.
template <class V, int kArc>
inline typename V::Bytes bestArc(const typename V::Bytes* difference) {
  typename V::Bytes two[8];   // [i]: least of pixels 2 i + 1, 2 i + 2
  typename V::Bytes four[8];  // [i]: least of pixels 2 i + 1 .. 2 i + 4
  for (int i = 0; i < 8; ++i) two[i] = V::min(difference[2 * i + 1], difference[(2 * i + 2) & 15]);
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

/// The scores of one polarity's corners.
template <class V, int kArc, bool kBrighter>
void scoreBlocks(const LaneBlocks<V>& blocks, const std::uint16_t* list, int count,
                 std::uint8_t* scores) {
  const auto one = V::broadcast(0x01010101U);
  for (int i = 0; i < count; ++i) {
    const int x = blocks.xBegin_px(list[i]);
    const auto centre = blocks.centre(x);
    const auto threshold = blocks.thresholds(list[i], x);
    const auto limit = kBrighter ? V::add(centre, threshold) : V::subtract(centre, threshold);
    typename V::Bytes difference[kCircleSize];
    for (int n = 0; n < kCircleSize; ++n) {
      const auto pixel = blocks.circle(n, x);
      difference[n] = kBrighter ? V::subtract(pixel, limit) : V::subtract(limit, pixel);
    }
    const auto excess = bestArc<V, kArc>(difference);
    const auto score = V::where(excess, V::add(excess, V::subtract(threshold, one)));
    // Not the first to write here: the other polarity, and the block that the last one overlaps.
    V::store(scores + x, V::max(score, V::load(scores + x)));
  }
}

template <class V, int kArc>
int scanRow(const FastRow& row, const FastCircle& circle, const FastScores& out) {
  constexpr bool kTwelve = kArc == 12;
  const LaneBlocks<V> blocks(row, circle.stride_bytes);
  LaneLists<V> lists;
  lists.either_count = listByCompass<V, kTwelve>(blocks, lists.either);
  keepByDiagonal<V, kTwelve>(blocks, lists);
  scoreBlocks<V, kArc, true>(blocks, lists.brighter, lists.brighter_count, out.scores);
  scoreBlocks<V, kArc, false>(blocks, lists.darker, lists.darker_count, out.scores);
  int count = 0;
  for (int i = 0; i < lists.either_count; ++i) {
    const int x = blocks.xBegin_px(lists.either[i]);
    out.groups[count] = static_cast<std::uint16_t>(x);
    count += static_cast<int>(V::any(V::load(out.scores + x)));
  }
  return count;
}

/// See fastRowScalar.
template <class V>
int fastRowLanes(const FastRow& row, const FastCircle& circle, const FastScores& out) {
  if (row.columns == 0) return 0;
  if (row.x_end_px - row.x_begin_px < V::kLanes) return fastRowScalar(row, circle, out);
  switch (circle.arc_length_px) {
    case 9:
      return scanRow<V, 9>(row, circle, out);
    case 10:
      return scanRow<V, 10>(row, circle, out);
    case 11:
      return scanRow<V, 11>(row, circle, out);
    default:
      return scanRow<V, 12>(row, circle, out);
  }
}

}  // namespace ardrone_vslam::kernels
