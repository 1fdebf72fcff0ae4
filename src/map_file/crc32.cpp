// SPDX-License-Identifier: BSD-3-Clause
#include "map_file/crc32.hpp"

#include <array>

#include "map_file/little_endian.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::size_t kStep = 8;  // bytes at a time, with a table for each
using Tables = std::array<std::array<std::uint32_t, 256>, kStep>;

/// tables[k][b]: what byte b does to the sum when k zero bytes follow it.
constexpr Tables makeTables() {
  constexpr std::uint32_t kPolynomial = 0xEDB88320U;  // bits reversed
  Tables tables{};
  for (std::uint32_t b = 0; b < 256; ++b) {
    std::uint32_t sum = b;
    for (int bit = 0; bit < 8; ++bit) sum = (sum >> 1) ^ ((sum & 1U) != 0 ? kPolynomial : 0U);
    tables[0][b] = sum;
  }
  for (std::size_t k = 1; k < kStep; ++k) {
    for (std::size_t b = 0; b < 256; ++b) {
      const std::uint32_t before = tables[k - 1][b];
      tables[k][b] = (before >> 8) ^ tables[0][before & 0xFFU];
    }
  }
  return tables;
}

constexpr Tables kTables = makeTables();

}  // namespace

void Crc32::add(const std::uint8_t* bytes, std::size_t count) {
  std::uint32_t sum = state_;
  for (; count >= kStep; count -= kStep, bytes += kStep) {
    const std::uint32_t low = sum ^ fromLittleEndian<std::uint32_t>(bytes);
    const auto high = fromLittleEndian<std::uint32_t>(bytes + 4);
    sum = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      sum ^= kTables[7 - i][(low >> (8 * i)) & 0xFFU];
      sum ^= kTables[3 - i][(high >> (8 * i)) & 0xFFU];
    }
  }
  for (; count > 0; --count, ++bytes) sum = (sum >> 8) ^ kTables[0][(sum ^ *bytes) & 0xFFU];
  state_ = sum;
}

}  // namespace ardrone_vslam
