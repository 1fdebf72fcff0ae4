// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace ardrone_vslam {

/// Header that the AR.Drone 2.0 puts before each part of its video (Parrot Video Encapsulation,
/// little endian, 64 bytes or more). Fields as far as they are needed.
struct PaveHeader {
  enum FrameType : std::uint8_t { kUnknown = 0, kIdr = 1, kI = 2, kP = 3, kHeaders = 4 };

  std::size_t header_size_bytes = 0;   ///< the payload begins behind it
  std::size_t payload_size_bytes = 0;  ///< H.264 byte stream
  std::uint8_t codec = 0;              ///< 4 is H.264
  int width_px = 0;                    ///< as displayed; the encoder's may be larger (368 rows)
  int height_px = 0;
  std::uint32_t frame_number = 0;
  std::uint32_t timestamp_ms = 0;  ///< the drone's clock
  std::uint8_t frame_type = kUnknown;
  std::uint8_t slice_count = 1;
  std::uint8_t slice_index = 0;
};

/// @return nothing when the bytes do not begin with a whole and plausible header
std::optional<PaveHeader> parsePaveHeader(const std::uint8_t* data, std::size_t size);

/// One picture: all its slices, with the parameter sets that came before it.
struct PaveFrame {
  PaveHeader header;  ///< of its first slice
  std::vector<std::uint8_t> payload;
};

struct PaveStatistics {
  std::size_t packets = 0;  ///< headers found
  std::size_t broken_packets =
      0;                          ///< cut short, grown, of an unknown codec, or their number absurd
  std::size_t garbage_bytes = 0;  ///< bytes passed over outside of any packet
  std::size_t lost_frames = 0;    ///< holes in the frame numbers
  std::size_t misordered_frames = 0;  ///< repeated or older frame numbers, dropped
  std::size_t other_size_frames = 0;  ///< of a size that hardly occurs, dropped
  std::size_t waiting_frames = 0;     ///< dropped for want of the picture they build on
};

struct PaveStream {
  /// Every frame can be decoded: an IDR picture comes first, after every hole and where the size
  /// changes.
  std::vector<PaveFrame> frames;
  PaveStatistics statistics;
};

/// Takes a recorded stream apart. Damage is passed over and counted: after garbage the next header
/// is looked for, after a hole the next IDR picture.
PaveStream parsePave(const std::uint8_t* data, std::size_t size);

}  // namespace ardrone_vslam
