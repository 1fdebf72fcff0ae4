// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

#include "fuzz/fuzz_target.hpp"

namespace ardrone_vslam::fuzz {

/// Takes an input apart from its front; behind the end everything is zero.
class FuzzInput {
 public:
  FuzzInput(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

  std::size_t left() const { return size_; }
  const std::uint8_t* data() const { return data_; }

  /// A number as it lies in memory.
  template <class T>
  T take() {
    T value{};
    const std::size_t count = std::min(sizeof(T), size_);
    if (count > 0) std::memcpy(&value, data_, count);
    skip(count);
    return value;
  }

  /// At most so many bytes.
  FuzzInput part(std::size_t count) {
    const FuzzInput taken(data_, std::min(count, size_));
    skip(taken.size_);
    return taken;
  }

  Bytes rest() const { return {data_, data_ + size_}; }
  std::string text() const { return {data_, data_ + size_}; }

 private:
  void skip(std::size_t count) {
    data_ += count;
    size_ -= count;
  }

  const std::uint8_t* data_;
  std::size_t size_;
};

/// Writes what FuzzInput takes.
template <class T>
void put(Bytes& bytes, const T& value) {
  const auto* const from = reinterpret_cast<const std::uint8_t*>(&value);
  bytes.insert(bytes.end(), from, from + sizeof(T));
}

/// A length of two bytes and so many bytes.
inline void putPart(Bytes& bytes, const Bytes& part) {
  put(bytes, static_cast<std::uint16_t>(part.size()));
  bytes.insert(bytes.end(), part.begin(), part.end());
}

}  // namespace ardrone_vslam::fuzz
