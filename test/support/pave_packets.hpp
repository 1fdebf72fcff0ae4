// SPDX-License-Identifier: BSD-3-Clause
// Packets of the AR.Drone's video stream.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "pave/pave.hpp"

namespace ardrone_vslam {

using Bytes = std::vector<std::uint8_t>;

struct Packet {
  std::uint32_t number = 0;
  std::uint8_t type = PaveHeader::kP;
  std::uint8_t slices = 1;
  std::uint8_t slice = 0;
  std::uint16_t width_px = 640;
  std::uint8_t codec = 4;
  std::size_t payload_bytes = 20;
  std::uint8_t fill = 0;  ///< of the payload; 0: the frame's number
  std::uint16_t height_px = 360;
  std::int64_t timestamp_ms = -1;  ///< below 0: by the number
  Bytes payload = {};              ///< empty: `payload_bytes` of `fill`
};

inline void put(Bytes& bytes, std::size_t offset, std::uint32_t value, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    bytes[offset + i] = static_cast<std::uint8_t>(value >> (8 * i));
  }
}

/// Header of 68 bytes, as the real ones are.
inline Bytes toBytes(const Packet& packet) {
  const auto fill = packet.fill != 0 ? packet.fill : static_cast<std::uint8_t>(packet.number);
  const Bytes payload = packet.payload.empty() ? Bytes(packet.payload_bytes, fill) : packet.payload;
  Bytes bytes(68 + payload.size());
  bytes[0] = 'P';
  bytes[1] = 'a';
  bytes[2] = 'V';
  bytes[3] = 'E';
  bytes[4] = 2;
  bytes[5] = packet.codec;
  put(bytes, 6, 68, 2);
  put(bytes, 8, static_cast<std::uint32_t>(payload.size()), 4);
  put(bytes, 12, packet.width_px, 2);
  put(bytes, 14, packet.height_px, 2);
  put(bytes, 16, packet.width_px, 2);
  put(bytes, 18, packet.height_px, 2);
  put(bytes, 20, packet.number, 4);
  put(bytes, 24,
      packet.timestamp_ms < 0 ? 1000 + 33 * packet.number
                              : static_cast<std::uint32_t>(packet.timestamp_ms),
      4);
  bytes[30] = packet.type;
  bytes[42] = packet.slices;
  bytes[43] = packet.slice;
  std::copy(payload.begin(), payload.end(), bytes.begin() + 68);
  return bytes;
}

inline Packet idr(std::uint32_t number) {
  Packet packet;
  packet.number = number;
  packet.type = PaveHeader::kIdr;
  return packet;
}

inline Packet dependent(std::uint32_t number) {
  Packet packet;
  packet.number = number;
  return packet;
}

inline Bytes join(const std::vector<Bytes>& parts) {
  Bytes all;
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace ardrone_vslam
