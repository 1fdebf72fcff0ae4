// SPDX-License-Identifier: BSD-3-Clause
#include "pave/pave.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace ardrone_vslam {
namespace {

constexpr std::size_t kMinHeaderSize_bytes = 64;
constexpr std::size_t kMaxHeaderSize_bytes = 512;
constexpr std::size_t kMaxPayloadSize_bytes = 4 << 20;  // a raw 1280x720 picture is below it
constexpr int kMaxWidth_px = 4096;
constexpr std::uint32_t kMostLost = 3000;  // frames; 100 s
constexpr std::size_t kFewestOfSize = 10;  // packets; a third of a second
constexpr std::uint8_t kH264 = 4;
constexpr std::uint8_t kSignature[4] = {'P', 'a', 'V', 'E'};

std::uint32_t littleEndian(const std::uint8_t* data, std::size_t byte_count) {
  std::uint32_t value = 0;
  for (std::size_t i = byte_count; i > 0; --i) value = (value << 8) | data[i - 1];
  return value;
}

using Size = std::pair<int, int>;  // width and height

Size sizeOf(const PaveHeader& header) {
  return {header.width_px, header.height_px};
}

/// Puts packets together to frames and drops what cannot be decoded.
class FrameAssembler {
 public:
  FrameAssembler(PaveStream& stream, std::set<Size> sizes)
      : stream_(stream), sizes_(std::move(sizes)) {}

  /// A hole in the bytes: the next picture's predecessor may be missing.
  void hole() { awaits_idr_ = true; }

  void add(const PaveHeader& header, const std::uint8_t* payload) {
    const std::uint8_t* end = payload + header.payload_size_bytes;
    if (header.frame_type == PaveHeader::kHeaders) {
      parameter_sets_.assign(payload, end);
      return;
    }
    if (isNextSlice(header)) {
      last_slice_index_ = header.slice_index;
      auto& joined = stream_.frames.back().payload;
      joined.insert(joined.end(), payload, end);
      return;
    }
    if (!isWanted(header)) return;
    PaveFrame frame;
    frame.header = header;
    frame.payload = std::move(parameter_sets_);
    frame.payload.insert(frame.payload.end(), payload, end);
    parameter_sets_.clear();
    last_slice_index_ = header.slice_index;
    stream_.frames.push_back(std::move(frame));
  }

 private:
  bool isNextSlice(const PaveHeader& header) const {
    return header.slice_count > 1 && has_number_ && !awaits_idr_ && !stream_.frames.empty() &&
           header.frame_number == last_number_ && header.slice_index > last_slice_index_;
  }

  static bool isIdr(const PaveHeader& header) { return header.frame_type == PaveHeader::kIdr; }

  bool isNumberWanted(const PaveHeader& header) {
    PaveStatistics& statistics = stream_.statistics;
    const bool is_idr = isIdr(header);
    if (has_number_ && header.frame_number <= last_number_) {
      // A restarted drone counts from the beginning again, with an IDR picture.
      const bool is_restart = is_idr && header.frame_number < last_number_;
      if (!is_restart) {
        ++statistics.misordered_frames;
        return false;
      }
    } else if (has_number_ && !is_idr && header.frame_number - last_number_ > kMostLost) {
      // No such hole: the number itself is damaged, and must not make all that follow look old.
      ++statistics.broken_packets;
      awaits_idr_ = true;
      return false;
    } else if (has_number_ && header.frame_number - last_number_ > kMostLost) {
      awaits_idr_ = true;  // a damaged number, or a stream that goes on: an IDR picture is sound
    } else if (has_number_ && header.frame_number > last_number_ + 1) {
      statistics.lost_frames += header.frame_number - last_number_ - 1;
      awaits_idr_ = true;
    }
    return true;
  }

  bool isWanted(const PaveHeader& header) {
    PaveStatistics& statistics = stream_.statistics;
    if (!isNumberWanted(header)) return false;
    has_number_ = true;
    last_number_ = header.frame_number;
    if (sizes_.count(sizeOf(header)) == 0) {
      ++statistics.other_size_frames;
      awaits_idr_ = true;
      return false;
    }
    if (!stream_.frames.empty() && sizeOf(stream_.frames.back().header) != sizeOf(header))
      awaits_idr_ = true;
    if (awaits_idr_ && !isIdr(header)) {
      ++statistics.waiting_frames;
      return false;
    }
    awaits_idr_ = false;
    return true;
  }

  PaveStream& stream_;
  std::set<Size> sizes_;
  std::vector<std::uint8_t> parameter_sets_;
  bool awaits_idr_ = true;
  bool has_number_ = false;
  std::uint32_t last_number_ = 0;
  std::uint8_t last_slice_index_ = 0;
};

/// Whether nothing or a signature, possibly cut off by the end, comes. What follows a packet must:
/// else bytes were lost from the packet or came into it, and its picture would be smeared.
bool startsLikeHeader(const std::uint8_t* data, std::size_t size) {
  return std::equal(data, data + std::min<std::size_t>(size, 4), kSignature);
}

/// First position at or behind `begin` where a header stands; `size` when there is none.
std::size_t findHeader(const std::uint8_t* data, std::size_t size, std::size_t begin) {
  const std::uint8_t* end = data + size;
  const std::uint8_t* position = data + begin;
  while (true) {
    position = std::search(position, end, kSignature, kSignature + 4);
    if (position == end) return size;
    if (parsePaveHeader(position, static_cast<std::size_t>(end - position))) {
      return static_cast<std::size_t>(position - data);
    }
    ++position;
  }
}

/// That of most packets, and those of a camera or setting that was switched to: others are damaged.
std::set<Size> soundSizes(const std::uint8_t* data, std::size_t size) {
  std::map<Size, std::size_t> packets;
  std::size_t most = 0;
  for (std::size_t i = findHeader(data, size, 0); i < size; i = findHeader(data, size, i + 4))
    most = std::max(most, ++packets[sizeOf(*parsePaveHeader(data + i, size - i))]);
  std::set<Size> sizes;
  for (const auto& one : packets) {
    if (one.second == most || one.second >= kFewestOfSize) sizes.insert(one.first);
  }
  return sizes;
}

}  // namespace

std::optional<PaveHeader> parsePaveHeader(const std::uint8_t* data, std::size_t size) {
  if (size < kMinHeaderSize_bytes || !std::equal(kSignature, kSignature + 4, data)) {
    return std::nullopt;
  }
  // Offsets in the header (Parrot's parrot_video_encapsulation_t): 4 version, 5 codec, 6 header
  // size, 8 payload size, 12 encoded width, 14 height, 16 displayed width, 18 height, 20 frame
  // number, 24 time stamp, 28 chunks, 29 chunk, 30 frame type, 42 slices, 43 slice.
  PaveHeader header;
  header.codec = data[5];
  header.header_size_bytes = littleEndian(data + 6, 2);
  header.payload_size_bytes = littleEndian(data + 8, 4);
  header.width_px = static_cast<int>(littleEndian(data + 16, 2));
  header.height_px = static_cast<int>(littleEndian(data + 18, 2));
  header.frame_number = littleEndian(data + 20, 4);
  header.timestamp_ms = littleEndian(data + 24, 4);
  header.frame_type = data[30];
  header.slice_count = data[42];
  header.slice_index = data[43];
  const bool is_plausible = header.header_size_bytes >= kMinHeaderSize_bytes &&
                            header.header_size_bytes <= kMaxHeaderSize_bytes &&
                            header.payload_size_bytes <= kMaxPayloadSize_bytes &&
                            header.width_px > 0 && header.width_px <= kMaxWidth_px &&
                            header.height_px > 0 && header.height_px <= kMaxWidth_px;
  return is_plausible ? std::optional<PaveHeader>(header) : std::nullopt;
}

PaveStream parsePave(const std::uint8_t* data, std::size_t size) {
  PaveStream stream;
  FrameAssembler assembler(stream, soundSizes(data, size));
  std::size_t position = findHeader(data, size, 0);
  stream.statistics.garbage_bytes += position;
  while (position < size) {
    const PaveHeader header = *parsePaveHeader(data + position, size - position);
    ++stream.statistics.packets;
    const std::size_t packet_end = position + header.header_size_bytes + header.payload_size_bytes;
    const bool is_followed =
        packet_end <= size && startsLikeHeader(data + packet_end, size - packet_end);
    const bool is_whole = is_followed && header.payload_size_bytes > 0 && header.codec == kH264;
    // Within a packet that is followed by another one, or by nothing, headers are payload.
    const std::size_t next = findHeader(data, size, is_followed ? packet_end : position + 4);
    if (is_whole) {
      assembler.add(header, data + position + header.header_size_bytes);
    } else {
      ++stream.statistics.broken_packets;
      assembler.hole();
    }
    if (next > packet_end) stream.statistics.garbage_bytes += next - packet_end;
    position = next;
  }
  return stream;
}

}  // namespace ardrone_vslam
