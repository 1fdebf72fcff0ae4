// SPDX-License-Identifier: BSD-3-Clause
#include "program/tool_main.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <vector>

namespace ardrone_vslam {
namespace {

TEST(ToolMain, SeedsAreARangeUpToTheLargest) {
  EXPECT_EQ(parseSeeds("3:5"), (std::vector<std::uint64_t>{3, 4, 5}));
  EXPECT_EQ(parseSeeds("18446744073709551615:18446744073709551615"),
            std::vector<std::uint64_t>{std::numeric_limits<std::uint64_t>::max()});
  for (const char* wrong : {"", "5", "5:3", "-1:2", "1:2x", "0:10000"})
    EXPECT_THROW(parseSeeds(wrong), UsageError) << wrong;
}

}  // namespace
}  // namespace ardrone_vslam
