// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "ardrone_vslam/features.hpp"
#include "ardrone_vslam/landmark.hpp"

namespace ardrone_vslam {

/// A workstation's view of the flight in datagrams of bounded size (docs/onboard.md): some of the
/// image's features, the landmarks seen since the last one, and in the room left over the others in
/// turn. TelemetryReader receives it, and forgets a landmark that did not come for two rounds.
class Telemetry {
 public:
  static constexpr std::size_t kBytes = 1400;  ///< fits into an Ethernet frame
  static constexpr std::size_t kMostFeatures = 100;
  static constexpr std::size_t kFixedBytes = 32;  ///< before the features, header included
  static constexpr std::size_t kFeatureBytes = 5;
  static constexpr std::size_t kLandmarkBytes = 20;

  /// @return bytes of the datagram
  std::size_t write(const ImageFeatures& features, const Landmarks& map,
                    std::array<std::uint8_t, kBytes>& datagram);

 private:
  std::uint32_t sequence_ = 0;
  std::uint32_t round_ = 0;
  std::size_t cursor_ = 0;       // of the landmarks sent in turn
  std::size_t seen_cursor_ = 0;  // of those looked through for new ones
  std::int64_t last_ns_ = 0;
};

}  // namespace ardrone_vslam
