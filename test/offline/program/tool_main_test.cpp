// SPDX-License-Identifier: BSD-3-Clause
#include "program/tool_main.hpp"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace ardrone_vslam {
namespace {

TEST(ToolMain, SeedsAreARangeUpToTheLargest) {
  EXPECT_EQ(parseSeeds("3:5"), (std::vector<std::uint64_t>{3, 4, 5}));
  EXPECT_EQ(parseSeeds("18446744073709551615:18446744073709551615"),
            std::vector<std::uint64_t>{std::numeric_limits<std::uint64_t>::max()});
  for (const char* wrong : {"", "5", "5:3", "-1:2", "1:2x", "0:10000", "+1:2",
                            "11111111111111111111111:11111111111111111111112"})
    EXPECT_THROW(parseSeeds(wrong), UsageError) << wrong;
}

/// What a tool with the options --length and --seed answers.
int answer(const std::string& option, const std::string& value) {
  CLI::App app("", "tool");
  double length = 0;
  std::uint64_t seed = 0;
  app.add_option("--length", length)->check(numberWithin(0, 10));
  addSeed(app, "--seed", seed, "");
  const std::array<std::string, 3> words{"tool", option, value};
  std::array<char*, 3> arguments{};
  for (std::size_t i = 0; i < words.size(); ++i)
    arguments.at(i) = const_cast<char*>(words.at(i).c_str());
  return runTool(app, 3, arguments.data(), [] { return 0; });
}

TEST(ToolMain, NumbersAreNumbersWithinTheirRange) {
  for (const char* good : {"0", "10", "2.5"}) EXPECT_EQ(answer("--length", good), 0) << good;
  for (const char* wrong : {"nan", "-nan", "NAN", "inf", "-1", "10.1", "x", ""})
    EXPECT_EQ(answer("--length", wrong), 2) << wrong;
}

TEST(ToolMain, ASeedFits) {
  EXPECT_EQ(answer("--seed", "18446744073709551615"), 0);
  for (const char* wrong : {"18446744073709551616", "11111111111111111111111", "-1", "1x", ""})
    EXPECT_EQ(answer("--seed", wrong), 2) << wrong;
}

}  // namespace
}  // namespace ardrone_vslam
