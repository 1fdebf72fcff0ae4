// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace ardrone_vslam {

/// Gives out pieces of memory that it was once given, and never asks for more. Each call takes a
/// bounded time, however the memory lies: free blocks are kept in lists by size, two levels with a
/// bitmap each, and join their free neighbours (Masmano et al., TLSF: a new dynamic memory
/// allocator for real-time systems, ECRTS 2004). Of the memory a sixteenth may be lost to the
/// rounding of sizes, and 16 bytes with each block. Not for two threads at a time.
/// Not malloc with mlockall, mallopt and RLIMIT_AS: these keep memory resident and limit it, but
/// glibc searches and joins its free blocks in a call, for a time that nothing bounds.
class FixedHeap {
 public:
  /// All addresses and sizes are multiples of it.
  static constexpr std::size_t kAlignment = 16;
  static constexpr std::size_t kLargestRegion = std::size_t{1} << 30;

  /// Constant, as the first call comes before any constructor of the program has run.
  constexpr FixedHeap() = default;

  /// Adds memory to give out. @param region  aligned to kAlignment @param bytes  kLargestRegion at
  /// most
  void add(void* region, std::size_t bytes);
  /// @param alignment  a power of two @return nullptr when there is no block so large
  void* allocate(std::size_t bytes, std::size_t alignment = kAlignment);
  /// @param memory  of allocate(), or nullptr
  void release(void* memory);
  /// Bytes that may be used there: at least those asked for.
  static std::size_t sizeOf(const void* memory);

  /// What all pieces that are in use take, headers included.
  std::size_t used() const { return used_; }
  /// The most that used() has been.
  std::size_t mostUsed() const { return most_used_; }
  /// All that was added.
  std::size_t capacity() const { return capacity_; }

 private:
  static constexpr int kSecondLevels = 16;
  static constexpr int kFirstLevels = 25;  // sizes below 2^32

  struct Block;
  struct FreeList {
    int first_level;
    int second_level;
  };

  static FreeList listOf(std::size_t bytes);
  FreeList listAtLeast(std::size_t bytes) const;
  void enter(Block* block);
  void leave(Block* block);
  void splitOff(Block* block, std::size_t bytes);
  void joinNext(Block* block);

  std::uint32_t first_levels_ = 0;  // bits of those with a free block
  std::array<std::uint32_t, kFirstLevels> second_levels_{};
  std::array<std::array<Block*, kSecondLevels>, kFirstLevels> lists_{};
  std::size_t used_ = 0;
  std::size_t most_used_ = 0;
  std::size_t capacity_ = 0;
};

}  // namespace ardrone_vslam
