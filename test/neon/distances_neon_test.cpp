// SPDX-License-Identifier: BSD-3-Clause
// Cross-compiled for ARM and run under emulation: no test library there.
#include <cstdio>
#include <random>
#include <vector>

#include "kernels/hamming/hamming_distances.hpp"

namespace ardrone_vslam::test {

/// @return number of faults
int testDistancesNeon() {
  int faults = 0;
  std::mt19937_64 random(8);
  for (std::size_t count = 0; count < 40; ++count) {
    std::vector<std::uint64_t> words(8 * (count + 1));
    for (std::size_t k = 0; k < words.size(); ++k)
      words[k] = k / 8 % 5 == 0 ? 0 : k / 8 % 5 == 1 ? ~std::uint64_t{0} : random();
    for (std::size_t query = 0; query <= count; ++query) {
      std::vector<std::uint16_t> expected(count + 1, 7777);
      std::vector<std::uint16_t> found(count + 1, 7777);
      const std::uint64_t* query_words = words.data() + 8 * query;
      kernels::hammingDistancesScalar(query_words, words.data(), count, expected.data());
      kernels::hammingDistancesNeon(query_words, words.data(), count, found.data());
      if (found == expected) continue;
      std::printf("hammingDistancesNeon differs: %d descriptors\n", static_cast<int>(count));
      ++faults;
    }
  }
  return faults;
}

}  // namespace ardrone_vslam::test
