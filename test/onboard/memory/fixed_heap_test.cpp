// SPDX-License-Identifier: BSD-3-Clause
#include "memory/fixed_heap.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <random>
#include <vector>

namespace ardrone_vslam {
namespace {

constexpr std::size_t kRegion_bytes = 1 << 20;

/// A heap of its own region.
struct OwnHeap {
  explicit OwnHeap(std::size_t bytes = kRegion_bytes) : region(bytes / sizeof(Line)) {
    heap.add(region.data(), bytes);
  }
  struct alignas(FixedHeap::kAlignment) Line {
    std::uint8_t bytes[FixedHeap::kAlignment];
  };
  std::vector<Line> region;
  FixedHeap heap;

  bool holds(const void* memory, std::size_t bytes) const {
    const auto* at = static_cast<const std::uint8_t*>(memory);
    const auto* begin = region.front().bytes;
    return at >= begin && at + bytes <= begin + region.size() * sizeof(Line);
  }
};

struct Piece {
  std::uint8_t* memory;
  std::size_t bytes;
  std::uint8_t content;

  bool isUntouched() const {
    return std::all_of(memory, memory + bytes, [&](std::uint8_t b) { return b == content; });
  }
};

TEST(FixedHeap, PiecesNeverOverlapAndAllComesBack) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    OwnHeap own;
    std::mt19937 random(seed);
    const auto below = [&](std::size_t n) {
      return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
    };
    std::vector<Piece> pieces;
    int refused = 0;
    for (int i = 0; i < 20000; ++i) {
      if (!pieces.empty() && below(100) < 45) {
        std::swap(pieces[below(pieces.size())], pieces.back());
        ASSERT_TRUE(pieces.back().isUntouched()) << "seed " << seed << ", step " << i;
        own.heap.release(pieces.back().memory);
        pieces.pop_back();
        continue;
      }
      const std::size_t bytes = below(std::size_t{1} << (1 + below(15)));
      const std::size_t alignment = std::size_t{1} << below(9);
      auto* memory = static_cast<std::uint8_t*>(own.heap.allocate(bytes, alignment));
      if (memory == nullptr) {
        ++refused;
        continue;
      }
      ASSERT_EQ(reinterpret_cast<std::uintptr_t>(memory) % std::max<std::size_t>(alignment, 16),
                0U);
      ASSERT_GE(FixedHeap::sizeOf(memory), bytes);
      const std::size_t usable = FixedHeap::sizeOf(memory);
      ASSERT_TRUE(own.holds(memory, usable));
      pieces.push_back({memory, usable, static_cast<std::uint8_t>(i)});
      std::memset(memory, i & 255, usable);
    }
    EXPECT_GT(refused, 0) << "the heap was never full: the test says little";
    for (const Piece& piece : pieces) {
      ASSERT_TRUE(piece.isUntouched());
      own.heap.release(piece.memory);
    }
    EXPECT_EQ(own.heap.used(), 0U);
    // All in one piece again, but for what the rounding of so large a size costs.
    EXPECT_NE(own.heap.allocate(kRegion_bytes * 15 / 16 - 64), nullptr);
  }
}

TEST(FixedHeap, WhatFitsIsFound) {
  OwnHeap own;
  std::vector<void*> pieces;
  while (void* memory = own.heap.allocate(100)) pieces.push_back(memory);
  EXPECT_EQ(pieces.size(), (kRegion_bytes - 32) / (112 + 16));
  while (own.heap.allocate(1) != nullptr) continue;  // what is left at the end
  EXPECT_EQ(own.heap.allocate(1), nullptr);
  own.heap.release(pieces[7]);
  EXPECT_EQ(own.heap.allocate(112), pieces[7]);
  // Two neighbours make room for what neither has room for, in whichever order they are returned.
  for (const auto& [first, second] : {std::pair(20, 21), std::pair(31, 30)}) {
    own.heap.release(pieces[static_cast<std::size_t>(first)]);
    EXPECT_EQ(own.heap.allocate(200), nullptr);
    own.heap.release(pieces[static_cast<std::size_t>(second)]);
    EXPECT_EQ(own.heap.allocate(200), pieces[static_cast<std::size_t>(std::min(first, second))]);
  }
}

TEST(FixedHeap, ASecondRegionIsUsedWhenTheFirstIsFull) {
  OwnHeap own(4096);
  OwnHeap further(1 << 16);
  EXPECT_EQ(own.heap.allocate(8000), nullptr);
  own.heap.add(further.region.data(), 1 << 16);
  void* memory = own.heap.allocate(8000);
  ASSERT_NE(memory, nullptr);
  EXPECT_TRUE(further.holds(memory, 8000));
  EXPECT_TRUE(own.holds(own.heap.allocate(2000), 2000));
}

TEST(FixedHeap, CountsWhatIsUsed) {
  OwnHeap own;
  void* first = own.heap.allocate(1000);
  void* second = own.heap.allocate(1);
  EXPECT_EQ(own.heap.used(), 1008U + 16 + 16 + 16);
  own.heap.release(first);
  own.heap.release(second);
  own.heap.release(nullptr);
  EXPECT_EQ(own.heap.used(), 0U);
  EXPECT_EQ(own.heap.mostUsed(), 1008U + 16 + 16 + 16);
  EXPECT_LE(own.heap.mostUsed(), own.heap.capacity());
}

TEST(FixedHeap, SizesThatCannotBeAreRefused) {
  OwnHeap own;
  for (const std::size_t bytes : {kRegion_bytes, std::size_t{1} << 31, SIZE_MAX - 15, SIZE_MAX})
    EXPECT_EQ(own.heap.allocate(bytes), nullptr) << bytes;
  for (const int power : {29, 30, 31}) {
    EXPECT_EQ(own.heap.allocate(16, std::size_t{1} << power), nullptr) << power;
    EXPECT_EQ(own.heap.allocate((std::size_t{1} << 30) - 1, std::size_t{1} << power), nullptr);
  }
  EXPECT_EQ(own.heap.used(), 0U);
}

}  // namespace
}  // namespace ardrone_vslam
