// SPDX-License-Identifier: BSD-3-Clause
// Numbers as bytes, the lowest first, whatever the processor's own order and alignment are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

namespace ardrone_vslam {

static_assert(std::numeric_limits<double>::is_iec559 && std::numeric_limits<float>::is_iec559,
              "floating point numbers are stored by their IEEE 754 bits");

/// Of an unsigned type.
template <typename Unsigned>
Unsigned fromLittleEndian(const std::uint8_t* bytes) {
  Unsigned value = 0;
  for (std::size_t i = 0; i < sizeof(Unsigned); ++i)
    value |= static_cast<Unsigned>(Unsigned{bytes[i]} << (8 * i));
  return value;
}

/// The bits of a number as another type of the same size.
template <typename To, typename From>
To bitsAs(const From& from) {
  static_assert(sizeof(To) == sizeof(From), "no bit may be lost");
  To to;
  std::memcpy(&to, &from, sizeof(To));
  return to;
}

/// Appends to a buffer.
class ByteWriter {
 public:
  void u32(std::uint32_t value) { put(value); }
  void u64(std::uint64_t value) { put(value); }
  void i64(std::int64_t value) { put(static_cast<std::uint64_t>(value)); }
  void f32(float value) { put(bitsAs<std::uint32_t>(value)); }
  void f64(double value) { put(bitsAs<std::uint64_t>(value)); }
  /// Its bytes alone.
  void raw(const char* text, std::size_t length) {
    bytes_.insert(bytes_.end(), text, text + length);
  }
  void append(const ByteWriter& other) {
    bytes_.insert(bytes_.end(), other.bytes_.begin(), other.bytes_.end());
  }
  /// Its length as u32 and its bytes.
  void text(const std::string& value) {
    u32(static_cast<std::uint32_t>(value.size()));
    raw(value.data(), value.size());
  }

  const std::uint8_t* data() const { return bytes_.data(); }
  std::size_t size() const { return bytes_.size(); }
  /// Empty again; the memory is kept.
  void clear() { bytes_.clear(); }

 private:
  template <typename Unsigned>
  void put(Unsigned value) {
    std::uint8_t bytes[sizeof(Unsigned)];
    for (std::size_t i = 0; i < sizeof(Unsigned); ++i)
      bytes[i] = static_cast<std::uint8_t>(value >> (8 * i));
    bytes_.insert(bytes_.end(), bytes, bytes + sizeof(Unsigned));
  }

  std::vector<std::uint8_t> bytes_;
};

/// Takes numbers from the front of bytes that somebody else owns. Behind their end all are 0, and
/// isShort() says so.
class ByteReader {
 public:
  ByteReader(const std::uint8_t* bytes, std::size_t count) : next_(bytes), remaining_(count) {}

  std::uint32_t u32() { return take<std::uint32_t>(); }
  std::uint64_t u64() { return take<std::uint64_t>(); }
  std::int64_t i64() { return bitsAs<std::int64_t>(take<std::uint64_t>()); }
  float f32() { return bitsAs<float>(take<std::uint32_t>()); }
  double f64() { return bitsAs<double>(take<std::uint64_t>()); }
  /// What ByteWriter::text wrote; empty where it is longer than `most`, which counts as short.
  std::string text(std::size_t most) {
    const std::size_t length = u32();
    if (length > most || length > remaining_) {
      is_short_ = true;
      return {};
    }
    const auto* first = next_;
    skip(length);
    return {first, first + length};
  }

  std::size_t remaining() const { return remaining_; }
  bool isShort() const { return is_short_; }

 private:
  template <typename Unsigned>
  Unsigned take() {
    if (remaining_ < sizeof(Unsigned)) {
      is_short_ = true;
      return 0;
    }
    const auto value = fromLittleEndian<Unsigned>(next_);
    skip(sizeof(Unsigned));
    return value;
  }
  void skip(std::size_t count) {
    next_ += count;
    remaining_ -= count;
  }

  const std::uint8_t* next_;
  std::size_t remaining_;
  bool is_short_ = false;
};

}  // namespace ardrone_vslam
