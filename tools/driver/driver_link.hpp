// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "simulation/random_source.hpp"

namespace ardrone_vslam {

/// The wireless link between drone and driver: about half of the packets come in sixes, the video
/// late. Equal seeds give equal links.
class DriverLink {
 public:
  /// @param perfect  everything arrives at once
  DriverLink(bool perfect, std::uint64_t seed)
      : perfect_(perfect), packets_(seed, 'P'), video_(seed, 'V') {}

  /// To be asked of each packet: whether it waits, to be received together with the next one.
  bool holdsPacket() {
    if (perfect_) return false;
    if (left_ == 0 && !packets_.chance(kBurstChance)) return false;
    if (left_ == 0) left_ = kBurstLength;
    return --left_ > 0;
  }
  /// To be asked of each image: from its exposure to its reception.
  std::int64_t videoDelay_ns() {
    return perfect_ ? 0 : static_cast<std::int64_t>(video_.integer(75'000, 100'000)) * 1000;
  }

 private:
  static constexpr std::size_t kBurstLength = 6;
  static constexpr double kBurstChance = 1.0 / 7;  // at each packet outside one: half are in bursts

  bool perfect_;
  RandomSource packets_;
  RandomSource video_;
  std::size_t left_ = 0;  // of the present burst
};

}  // namespace ardrone_vslam
