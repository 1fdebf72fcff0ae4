// SPDX-License-Identifier: BSD-3-Clause
#include "input_checks/decode_image.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <opencv2/imgcodecs.hpp>

namespace ardrone_vslam {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::array<std::uint8_t, 3> kJpegStart{0xff, 0xd8, 0xff};
constexpr std::array<std::uint8_t, 8> kPngStart{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};

template <std::size_t kSize>
bool startsWith(const Bytes& bytes, const std::array<std::uint8_t, kSize>& start) {
  return bytes.size() >= kSize && std::equal(start.begin(), start.end(), bytes.begin());
}

std::size_t bigEndian(const Bytes& bytes, std::size_t at) {
  std::size_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | bytes[at + i];
  return value;
}

/// Walks the segments, as a preview within one has an end of its own.
bool hasJpegEnd(const Bytes& bytes) {
  std::size_t at = 2;
  while (at < bytes.size()) {
    const void* marker = std::memchr(bytes.data() + at, 0xff, bytes.size() - at);
    if (marker == nullptr) return false;
    at = static_cast<std::size_t>(static_cast<const std::uint8_t*>(marker) - bytes.data()) + 1;
    if (at >= bytes.size()) return false;
    const std::uint8_t code = bytes[at];
    if (code == 0xd9) return true;
    if (code == 0xff) continue;  // a fill byte
    ++at;
    // Within a scan: a stuffed zero and restart markers. They stand alone, as does TEM.
    const bool is_alone = code <= 0x01 || (code >= 0xd0 && code <= 0xd7);
    if (is_alone) continue;
    if (at + 2 > bytes.size()) return false;
    at += static_cast<std::size_t>(bytes[at]) << 8 | bytes[at + 1];
  }
  return false;
}

bool hasPngEnd(const Bytes& bytes) {
  constexpr std::size_t kFrame = 12;  // of a chunk: length, name and check sum
  std::size_t at = kPngStart.size();
  while (at + kFrame <= bytes.size()) {
    if (std::memcmp(bytes.data() + at + 4, "IEND", 4) == 0) return true;
    at += kFrame + bigEndian(bytes, at);
  }
  return false;
}

/// Whether a chunk without which there is no image has another check sum than it says. libpng finds
/// that, too, but prints it.
bool isDamagedPng(const Bytes& bytes) {
  if (!startsWith(bytes, kPngStart)) return false;
  constexpr std::size_t kName = 4, kSum = 4;
  std::size_t at = kPngStart.size();
  while (at + 8 + kSum <= bytes.size()) {
    const std::size_t length = bigEndian(bytes, at);
    const std::uint8_t* name = bytes.data() + at + 4;
    if (length > bytes.size() - at - 8 - kSum) return true;
    const bool is_critical = (*name & 0x20) == 0;
    const auto sum = crc32(0, name, static_cast<uInt>(kName + length));
    if (is_critical && sum != bigEndian(bytes, at + 8 + length)) return true;
    if (std::memcmp(name, "IEND", kName) == 0) return false;
    at += 8 + length + kSum;
  }
  return true;
}

}  // namespace

bool isCutOff(const Bytes& encoded) {
  if (startsWith(encoded, kJpegStart)) return !hasJpegEnd(encoded);
  if (startsWith(encoded, kPngStart)) return !hasPngEnd(encoded);
  return false;
}

cv::Mat decodeGrey(const Bytes& encoded) {
  if (encoded.empty() || isCutOff(encoded) || isDamagedPng(encoded)) return {};
  return cv::imdecode(encoded, cv::IMREAD_GRAYSCALE);
}

}  // namespace ardrone_vslam
