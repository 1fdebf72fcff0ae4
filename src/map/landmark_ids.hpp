// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace ardrone_vslam {

/// They count up, and begin anew after months of flight.
class LandmarkIds {
 public:
  static constexpr std::uint32_t kLargest = 0x7fffffff;  ///< the index has them as signed numbers

  /// @param next  of 1 .. largest
  explicit LandmarkIds(std::uint32_t next = 1, std::uint32_t largest = kLargest)
      : next_(next), largest_(largest) {}

  /// @param in_use  has a count() of each id; not all may be in it
  template <class Ids>
  std::uint32_t take(const Ids& in_use) {
    std::uint32_t id = 0;
    do {
      id = next_;
      next_ = id == largest_ ? 1 : id + 1;
    } while (in_use.count(id) != 0);
    return id;
  }

 private:
  std::uint32_t next_;
  std::uint32_t largest_;
};

}  // namespace ardrone_vslam
