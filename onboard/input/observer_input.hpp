// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "ardrone_vslam/odometry_buffer.hpp"

namespace ardrone_vslam {

/// Records of the controller (vslam_protocol.h) -> observer states; what is not good is dropped and
/// counted.
class ObserverInput {
 public:
  struct Counts {
    std::uint32_t accepted = 0;
    std::uint32_t wrong_size = 0;
    std::uint32_t wrong_kind = 0;
    std::uint32_t corrupted = 0;
    std::uint32_t old = 0;  ///< their sequence number is not newer
    std::uint32_t refused =
        0;  ///< not finite, no rotation, out of bounds, a stamp that does not ascend

    std::uint32_t dropped() const { return wrong_size + wrong_kind + corrupted + old + refused; }
  };
  /// After so long without a record any sequence number is new: the controller began again.
  static constexpr std::int64_t kForget_ns = 1'000'000'000;

  /// @param now_ns  of any clock that never goes back
  std::optional<OdometryState> read(const std::uint8_t* record, std::size_t size,
                                    std::int64_t now_ns);
  /// A state of read() that the stages behind it refused.
  void countRefused() { ++counts_.refused; }

  /// No good record for `limit_s`, or none yet.
  bool isSilent(std::int64_t now_ns, double limit_s) const;
  const Counts& counts() const { return counts_; }

 private:
  Counts counts_;
  std::uint32_t sequence_ = 0;
  std::int64_t heard_ns_ = 0;
  bool has_heard_ = false;
};

}  // namespace ardrone_vslam
