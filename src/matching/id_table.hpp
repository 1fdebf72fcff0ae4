// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace ardrone_vslam {

/// From an id to a small value: an open addressing hash table (linear probing; what is erased is
/// filled from behind, Knuth 6.4, algorithm R). It takes 2 slots an entry in the mean, where
/// std::unordered_map takes an allocation and 40 bytes. Each function is O(1) but where it grows.
template <class Value>
class IdTable {
 public:
  static constexpr std::uint32_t kNoId = 0xffffffff;  ///< no entry has it

  std::size_t size() const { return size_; }
  std::size_t count(std::uint32_t id) const { return find(id) != nullptr ? 1 : 0; }
  /// @return nullptr when there is none; valid until the table is changed
  const Value* find(std::uint32_t id) const {
    if (slots_.empty() || id == kNoId) return nullptr;
    const Slot& slot = slots_[slotOf(id)];
    return slot.id == id ? &slot.value : nullptr;
  }
  /// Enters it, or changes what is there.
  void set(std::uint32_t id, const Value& value) {
    assert(id != kNoId);
    if (count(id) == 0) reserve(++size_);
    slots_[slotOf(id)] = {id, value};
  }
  /// @pre it is there (asserted)
  const Value& at(std::uint32_t id) const {
    const Value* value = find(id);
    assert(value != nullptr);
    return *value;
  }
  /// Ids that are not there are ignored.
  void erase(std::uint32_t id) {
    if (slots_.empty() || id == kNoId) return;
    std::size_t hole = slotOf(id);
    if (slots_[hole].id != id) return;
    for (std::size_t i = next(hole); slots_[i].id != kNoId; i = next(i)) {
      const std::size_t home = homeOf(slots_[i].id);
      // Whether its home lies behind the hole, up to where it is.
      const bool may_stay = hole < i ? hole < home && home <= i : hole < home || home <= i;
      if (may_stay) continue;
      slots_[hole] = slots_[i];
      hole = i;
    }
    slots_[hole].id = kNoId;
    --size_;
  }
  void clear() { *this = IdTable(); }
  /// Takes the memory for so many entries.
  void reserve(std::size_t count) {
    constexpr std::size_t kFewest = 16;
    std::size_t slots = slots_.empty() ? kFewest : slots_.size();
    while (4 * count > 3 * slots) slots *= 2;
    if (slots == slots_.size()) return;
    for (shift_ = 32; slots >> (32 - shift_) > 1;) --shift_;
    const std::vector<Slot> old = std::exchange(slots_, std::vector<Slot>(slots));
    for (const Slot& slot : old) {
      if (slot.id != kNoId) slots_[slotOf(slot.id)] = slot;
    }
  }

 private:
  struct Slot {
    std::uint32_t id = kNoId;
    Value value{};
  };

  /// Fibonacci hashing (Knuth 6.4): ids that follow each other lie far apart. As their own homes
  /// they would form runs that later ids, a table's size on, must pass.
  std::size_t homeOf(std::uint32_t id) const { return id * 2654435769U >> shift_; }
  std::size_t next(std::size_t slot) const { return (slot + 1) & (slots_.size() - 1); }
  /// Where it is, or would be.
  std::size_t slotOf(std::uint32_t id) const {
    std::size_t slot = homeOf(id);
    while (slots_[slot].id != id && slots_[slot].id != kNoId) slot = next(slot);
    return slot;
  }

  std::vector<Slot> slots_;  // a power of two, a quarter of them free
  unsigned shift_ = 32;      // 32 - log2 of their number
  std::size_t size_ = 0;
};

}  // namespace ardrone_vslam
