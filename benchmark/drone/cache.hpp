// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace ardrone_vslam::drone {

// Which lines a cache holds: sets of `ways` lines, of which the longest unused one gives way.
class Cache {
 public:
  Cache(std::size_t bytes, std::size_t ways, unsigned line_bits)
      : ways_(ways),
        line_bits_(line_bits),
        sets_((bytes >> line_bits) / ways),
        lines_(sets_ * ways, kNothing) {}

  // Whether the line of an address was there. It is afterwards, as the set's newest, if `keep`.
  // Cost: `ways` comparisons.
  bool lookUp(std::uint32_t address, bool keep) {
    const std::uint32_t line = address >> line_bits_;
    std::uint32_t* set = &lines_[line % sets_ * ways_];
    std::size_t place = 0;
    while (place < ways_ && set[place] != line) ++place;
    const bool found = place < ways_;
    if (!found && !keep) return false;
    for (std::size_t i = found ? place : ways_ - 1; i > 0; --i) set[i] = set[i - 1];
    set[0] = line;
    return found;
  }

 private:
  static constexpr std::uint32_t kNothing = 0xffffffff;
  std::size_t ways_;
  unsigned line_bits_;
  std::size_t sets_;
  std::vector<std::uint32_t> lines_;  // of each set, newest first
};

}  // namespace ardrone_vslam::drone
