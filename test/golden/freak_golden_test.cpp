// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "support/freak_reference.hpp"
#include "support/generated_image.hpp"
#include "support/test_paths.hpp"

namespace ardrone_vslam::test {
namespace {

constexpr std::uint64_t kImageHash = 0x0e48fe666f505fb9U;

class FreakGolden : public ::testing::TestWithParam<std::pair<const char*, std::size_t>> {};

TEST_P(FreakGolden, EveryBitAndEveryAngleIsThePublishedDescriptors) {
  const auto [mode, row_count] = GetParam();
  const TestImage image = generatedImage(320, 240);
  ASSERT_EQ(hashOf(image.bytes), kImageHash)
      << "the test makes another image than the reference was computed for";
  const auto rows = rowsOf(readFreakRows(test::dataFile("freak/generated_320x240.csv")),
                           "generated_320x240", mode);
  ASSERT_EQ(rows.size(), row_count);
  for (const InstructionSet set : supportedInstructionSets()) {
    for (const std::string& difference : differencesFrom(rows, image.view(), set))
      ADD_FAILURE() << difference;
  }
}

INSTANTIATE_TEST_SUITE_P(Modes, FreakGolden,
                         ::testing::Values(std::make_pair("oriented", std::size_t{297}),
                                           std::make_pair("upright", std::size_t{11}),
                                           std::make_pair("oriented_scaled", std::size_t{28})),
                         [](const auto& parameter) { return std::string(parameter.param.first); });

}  // namespace
}  // namespace ardrone_vslam::test
