// SPDX-License-Identifier: BSD-3-Clause
// Cross-compiled for ARM and run under emulation: no test library there.
#include <cstdio>
#include <random>
#include <vector>

#include "kernels/hamming/hamming_window.hpp"

namespace ardrone_vslam::test {
namespace {

struct Answers {
  std::vector<kernels::HammingNearest> nearest;
  std::vector<std::int32_t> query_bits, query;

  bool operator==(const Answers& other) const {
    for (std::size_t q = 0; q < nearest.size(); ++q) {
      const kernels::HammingNearest& a = nearest[q];
      const kernels::HammingNearest& b = other.nearest[q];
      if (a.index != b.index || a.distance_bits != b.distance_bits ||
          a.second_distance_bits != b.second_distance_bits)
        return false;
    }
    return query_bits == other.query_bits && query == other.query;
  }
};

}  // namespace

/// @return number of faults
int testWindowNeon() {
  int faults = 0;
  std::mt19937_64 random(9);
  for (std::size_t count = 0; count < 60; ++count) {
    const std::size_t room = count + kernels::kWindowPadding;
    std::vector<std::uint64_t> words(8 * room);
    std::vector<float> x_px(room);
    std::vector<float> y_px(room);
    std::vector<std::int32_t> index(room);
    const std::uint64_t mask = count % 2 == 0 ? 3 : ~std::uint64_t{0};
    for (std::uint64_t& word : words) word = random() & mask;
    for (std::size_t k = 0; k < room; ++k) {
      x_px[k] = static_cast<float>(random() % 40);
      y_px[k] = static_cast<float>(random() % 40);
      index[k] = static_cast<std::int32_t>(1000 - k);
    }
    const auto answersOf = [&](auto window) {
      Answers answers;
      answers.query_bits.assign(room, 513);
      answers.query.assign(room, -1);
      for (std::int32_t q = 0; q < 20; ++q) {
        const std::size_t half = count / 2;
        const kernels::HammingRange ranges[] = {{0, half}, {half + half / 3, count}};
        answers.nearest.push_back({-1, 513, 513});
        window({words.data(), x_px.data(), y_px.data(), index.data(), answers.query_bits.data(),
                answers.query.data()},
               {words.data() + 8 * (static_cast<std::size_t>(q) % room), static_cast<float>(q),
                20.F, 225.F, q},
               ranges, 2, answers.nearest.back());
      }
      return answers;
    };
    if (answersOf(kernels::hammingWindowNeon) == answersOf(kernels::hammingWindowScalar)) continue;
    std::printf("hammingWindowNeon differs: %d descriptors\n", static_cast<int>(count));
    ++faults;
  }
  return faults;
}

}  // namespace ardrone_vslam::test
