// SPDX-License-Identifier: BSD-3-Clause
#include "memory/fixed_heap.hpp"

#include <algorithm>

namespace ardrone_vslam {

/// Stands before its memory. Blocks lie one behind the other; behind the last one of a region is
/// one without memory, which is never free.
struct alignas(FixedHeap::kAlignment) FixedHeap::Block {
  Block* before;  // its neighbour, nullptr: none
  std::uint32_t bytes;
  bool is_free;

  // Of a free block, in its memory.
  struct Links {
    Block* next;
    Block* previous;
  };

  unsigned char* memory() { return reinterpret_cast<unsigned char*>(this + 1); }
  Links& links() { return *reinterpret_cast<Links*>(memory()); }
  Block* after() { return reinterpret_cast<Block*>(memory() + bytes); }
  static Block* of(void* memory) { return static_cast<Block*>(memory) - 1; }
};

namespace {

/// With room for an alignment, and rounded up, a size stays below 2^32.
constexpr std::size_t kLargest = FixedHeap::kLargestRegion;
/// Below it there is a list for each size.
constexpr std::size_t kLarge = 256;

int log2Of(std::size_t n) {
  return 63 - __builtin_clzll(n);
}

std::size_t roundedUp(std::size_t bytes, std::size_t to) {
  return (bytes + to - 1) / to * to;
}

}  // namespace

FixedHeap::FreeList FixedHeap::listOf(std::size_t bytes) {
  if (bytes < kLarge) return {0, static_cast<int>(bytes / kAlignment)};
  const int top = log2Of(bytes);
  return {top - log2Of(kLarge) + 1, static_cast<int>(bytes >> (top - 4)) & (kSecondLevels - 1)};
}

/// The first list that has a block, all of whose blocks are large enough; first_level is negative
/// when there is none.
FixedHeap::FreeList FixedHeap::listAtLeast(std::size_t bytes) const {
  if (bytes >= kLarge) bytes += (std::size_t{1} << (log2Of(bytes) - 4)) - 1;
  FreeList list = listOf(bytes);
  std::uint32_t second = second_levels_[static_cast<std::size_t>(list.first_level)] &
                         (~std::uint32_t{0} << list.second_level);
  if (second == 0) {
    const std::uint32_t first = first_levels_ & (~std::uint32_t{1} << list.first_level);
    if (first == 0) return {-1, 0};
    list.first_level = __builtin_ctz(first);
    second = second_levels_[static_cast<std::size_t>(list.first_level)];
  }
  list.second_level = __builtin_ctz(second);
  return list;
}

void FixedHeap::enter(Block* block) {
  const FreeList list = listOf(block->bytes);
  const auto level = static_cast<std::size_t>(list.first_level);
  Block*& head = lists_[level][static_cast<std::size_t>(list.second_level)];
  block->is_free = true;
  block->links() = {head, nullptr};
  if (head != nullptr) head->links().previous = block;
  head = block;
  first_levels_ |= std::uint32_t{1} << list.first_level;
  second_levels_[level] |= std::uint32_t{1} << list.second_level;
}

void FixedHeap::leave(Block* block) {
  const Block::Links links = block->links();
  block->is_free = false;
  if (links.next != nullptr) links.next->links().previous = links.previous;
  if (links.previous != nullptr) {
    links.previous->links().next = links.next;
    return;
  }
  const FreeList list = listOf(block->bytes);
  const auto level = static_cast<std::size_t>(list.first_level);
  lists_[level][static_cast<std::size_t>(list.second_level)] = links.next;
  if (links.next != nullptr) return;
  second_levels_[level] &= ~(std::uint32_t{1} << list.second_level);
  if (second_levels_[level] == 0) first_levels_ &= ~(std::uint32_t{1} << list.first_level);
}

/// Leaves `bytes` to the block; what is behind them becomes free, if it is enough for a block.
void FixedHeap::splitOff(Block* block, std::size_t bytes) {
  if (block->bytes < bytes + sizeof(Block) + kAlignment) return;
  Block* const after = block->after();
  const auto left = static_cast<std::uint32_t>(block->bytes - bytes - sizeof(Block));
  block->bytes = static_cast<std::uint32_t>(bytes);
  Block* const rest = block->after();
  *rest = {block, left, false};
  after->before = rest;
  enter(rest);
}

/// The next block, which is in no list any more, becomes part of this one.
void FixedHeap::joinNext(Block* block) {
  block->bytes += static_cast<std::uint32_t>(sizeof(Block)) + block->after()->bytes;
  block->after()->before = block;
}

void FixedHeap::add(void* region, std::size_t bytes) {
  const auto memory =
      static_cast<std::uint32_t>((bytes - 2 * sizeof(Block)) / kAlignment * kAlignment);
  auto* const block = static_cast<Block*>(region);
  *block = {nullptr, memory, false};
  *block->after() = {block, 0, false};
  capacity_ += memory + sizeof(Block);
  enter(block);
}

void* FixedHeap::allocate(std::size_t bytes, std::size_t alignment) {
  if (bytes >= kLargest || alignment >= kLargest) return nullptr;
  bytes = roundedUp(std::max(bytes, kAlignment), kAlignment);
  // Room to begin further behind, where the part before it is a block, too.
  const std::size_t spare = alignment <= kAlignment ? 0 : alignment + sizeof(Block) + kAlignment;
  const FreeList list = listAtLeast(bytes + spare);
  if (list.first_level < 0) return nullptr;
  Block* block = lists_[static_cast<std::size_t>(list.first_level)]
                       [static_cast<std::size_t>(list.second_level)];
  leave(block);
  if (spare > 0) {
    const auto at = reinterpret_cast<std::uintptr_t>(block->memory());
    if (at % alignment != 0) {
      const std::size_t begin = roundedUp(at + sizeof(Block) + kAlignment, alignment);
      splitOff(block, begin - at - sizeof(Block));
      Block* const front = block;
      block = block->after();
      leave(block);
      enter(front);
    }
  }
  splitOff(block, bytes);
  used_ += sizeof(Block) + block->bytes;
  most_used_ = std::max(most_used_, used_);
  return block->memory();
}

void FixedHeap::release(void* memory) {
  if (memory == nullptr) return;
  Block* block = Block::of(memory);
  used_ -= sizeof(Block) + block->bytes;
  if (block->after()->is_free) {
    leave(block->after());
    joinNext(block);
  }
  if (block->before != nullptr && block->before->is_free) {
    block = block->before;
    leave(block);
    joinNext(block);
  }
  enter(block);
}

std::size_t FixedHeap::sizeOf(const void* memory) {
  return Block::of(const_cast<void*>(memory))->bytes;
}

}  // namespace ardrone_vslam
