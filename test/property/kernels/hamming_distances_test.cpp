// SPDX-License-Identifier: BSD-3-Clause
#include "kernels/hamming/hamming_distances.hpp"

#include <gtest/gtest.h>

#include <random>

#include "kernels/kernels.hpp"
#include "support/grey_images.hpp"

namespace ardrone_vslam::test {
namespace {

class HammingDistances : public ::testing::TestWithParam<InstructionSet> {};

TEST_P(HammingDistances, EqualScalarForEveryCountAndAlignment) {
  const auto distances = kernels::kernelsFor(GetParam()).hamming_distances;
  for (const unsigned seed : testSeeds()) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    std::vector<std::uint64_t> words(8 * 45);
    for (std::size_t k = 0; k < words.size(); ++k)
      words[k] = k / 8 % 5 == 0 ? 0 : k / 8 % 5 == 1 ? ~std::uint64_t{0} : random();
    for (std::size_t offset = 0; offset < 8; ++offset) {  // descriptors need not be aligned
      for (const std::size_t query : {0U, 8U, 16U, 83U}) {
        for (std::size_t count = 0; count < 40; ++count) {
          std::vector<std::uint16_t> expected(count + 1, 7777);
          std::vector<std::uint16_t> found(count + 1, 7777);
          kernels::hammingDistancesScalar(&words[query], &words[offset], count, expected.data());
          distances(&words[query], &words[offset], count, found.data());
          ASSERT_EQ(found, expected) << count << ' ' << offset;  // and nothing behind the end
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sets, HammingDistances, ::testing::ValuesIn(supportedInstructionSets()),
                         [](const auto& parameter) { return nameOf(parameter.param); });

}  // namespace
}  // namespace ardrone_vslam::test
