// SPDX-License-Identifier: BSD-3-Clause
// The AR.Drone's video stream: damage is passed over and counted, and what is left can be decoded.
#include <numeric>

#include "fuzz/fuzz_input.hpp"
#include "pave/pave_stamps.hpp"
#include "support/pave_packets.hpp"

namespace ardrone_vslam::fuzz {
namespace {

void requireDecodable(const PaveStream& stream, std::size_t size) {
  std::size_t payload_bytes = 0;
  const PaveHeader* before = nullptr;
  for (const PaveFrame& frame : stream.frames) {
    const PaveHeader& header = frame.header;
    require(!frame.payload.empty(), "no picture is empty");
    payload_bytes += frame.payload.size();
    const bool is_idr = header.frame_type == PaveHeader::kIdr;
    const bool goes_on = before != nullptr && header.frame_number == before->frame_number + 1 &&
                         header.width_px == before->width_px &&
                         header.height_px == before->height_px;
    require(is_idr || goes_on, "an IDR picture comes first, after a hole and at another size");
    before = &header;
  }
  require(payload_bytes <= size, "no byte is there twice");
  require(stream.statistics.garbage_bytes <= size, "garbage is no more than there is");
}

void requireAscending(const PaveStream& stream) {
  std::vector<PaveHeader> headers;
  for (const PaveFrame& frame : stream.frames) headers.push_back(frame.header);
  const PaveStamps stamps = stampsOf(headers);
  require(stamps.frames.size() == stamps.stamps_ns.size(), "each frame has its stamp");
  for (std::size_t i = 0; i < stamps.frames.size(); ++i) {
    require(stamps.frames[i] < headers.size(), "stamps are of frames that are there");
    require(i == 0 || (stamps.frames[i] > stamps.frames[i - 1] &&
                       stamps.stamps_ns[i] > stamps.stamps_ns[i - 1]),
            "frames and stamps ascend");
  }
}

Bytes stream(const std::vector<Packet>& packets) {
  Bytes all;
  for (const Packet& packet : packets) {
    const Bytes bytes = toBytes(packet);
    all.insert(all.end(), bytes.begin(), bytes.end());
  }
  return all;
}

}  // namespace

std::vector<Bytes> seeds() {
  Packet parameters = dependent(3);
  parameters.type = PaveHeader::kHeaders;
  std::vector<Packet> slices{idr(1), idr(1), dependent(2), dependent(2)};
  for (std::size_t i = 0; i < slices.size(); ++i) {
    slices[i].slices = 2;
    slices[i].slice = static_cast<std::uint8_t>(i % 2);
  }
  std::vector<Packet> long_run{idr(1)};
  for (std::uint32_t i = 2; i < 14; ++i) long_run.push_back(dependent(i));
  std::vector<Packet> still = long_run;
  for (Packet& packet : still) packet.timestamp_ms = 7;
  return {stream({idr(1), dependent(2), parameters, dependent(3), idr(4)}),
          stream({idr(1), dependent(2), dependent(5), dependent(6), idr(7), dependent(8)}),
          stream({idr(100), dependent(101), idr(1), dependent(2)}),
          stream(slices),
          stream(long_run),
          stream(still)};
}

/// The payloads' sizes, by where the next packet begins.
std::size_t repair(std::uint8_t* data, std::size_t size, std::size_t /*most_size*/) {
  constexpr std::size_t kHeader = 68;
  constexpr std::uint8_t kSignature[4] = {'P', 'a', 'V', 'E'};
  std::uint8_t* const end = data + size;
  std::uint8_t* packet = std::search(data, end, kSignature, kSignature + 4);
  while (end - packet >= static_cast<std::ptrdiff_t>(kHeader)) {
    std::uint8_t* const next = std::search(packet + kHeader, end, kSignature, kSignature + 4);
    const auto payload = static_cast<std::size_t>(next - packet) - kHeader;
    for (std::size_t i = 0; i < 2; ++i) packet[6 + i] = static_cast<std::uint8_t>(kHeader >> 8 * i);
    for (std::size_t i = 0; i < 4; ++i) packet[8 + i] = static_cast<std::uint8_t>(payload >> 8 * i);
    packet = next;
  }
  return size;
}

}  // namespace ardrone_vslam::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const ardrone_vslam::PaveStream stream = ardrone_vslam::parsePave(data, size);
  ardrone_vslam::fuzz::requireDecodable(stream, size);
  ardrone_vslam::fuzz::requireAscending(stream);
  return 0;
}
