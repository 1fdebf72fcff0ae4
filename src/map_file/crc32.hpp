// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

namespace ardrone_vslam {

/// The check sum of IEEE 802.3, as zip and PNG have it, of bytes that come piece by piece.
class Crc32 {
 public:
  /// Appends bytes.
  void add(const std::uint8_t* bytes, std::size_t count);
  /// Of all bytes so far.
  std::uint32_t value() const { return ~state_; }

 private:
  std::uint32_t state_ = 0xFFFFFFFFU;
};

}  // namespace ardrone_vslam
