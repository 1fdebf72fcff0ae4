// SPDX-License-Identifier: BSD-3-Clause
#include "matching/id_table.hpp"

#include <gtest/gtest.h>

#include <random>
#include <unordered_map>

namespace ardrone_vslam {
namespace {

using Expected = std::unordered_map<std::uint32_t, int>;

void expectEqual(const IdTable<int>& table, const Expected& expected, std::uint32_t largest) {
  ASSERT_EQ(table.size(), expected.size());
  for (const auto& [id, value] : expected) {
    ASSERT_NE(table.find(id), nullptr) << id;
    ASSERT_EQ(table.at(id), value) << id;
  }
  for (std::uint32_t id = 0; id <= largest; ++id) ASSERT_EQ(table.count(id), expected.count(id));
}

/// Few ids, so that all that can happen to runs of slots happens.
TEST(IdTable, IsWhatTheLibrarysMapIs) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    IdTable<int> table;
    Expected expected;
    const auto largest = static_cast<std::uint32_t>(20 + random() % 300);
    for (int step = 0; step < 5000; ++step) {
      const auto id = static_cast<std::uint32_t>(random() % (largest + 1));
      if (random() % 2 == 0) {
        table.erase(id);
        expected.erase(id);
      } else {
        table.set(id, step);
        expected[id] = step;
      }
      if (step % 100 == 0) expectEqual(table, expected, largest);
    }
  }
}

/// As landmarks' are: they count up, and some of all ages are left.
TEST(IdTable, IdsThatCountUp) {
  IdTable<int> table;
  Expected expected;
  std::mt19937 random(1);
  for (std::uint32_t id = 0; id < 100'000; ++id) {
    table.set(id, static_cast<int>(id));
    expected[id] = static_cast<int>(id);
    const auto old = static_cast<std::uint32_t>(random() % (id + 1));
    if (id % 3 == 0) continue;
    table.erase(old);
    expected.erase(old);
  }
  expectEqual(table, expected, 100'000);
  table.clear();
  EXPECT_EQ(table.size(), 0U);
  EXPECT_EQ(table.find(5), nullptr);
  table.set(5, 1);
  table.erase(IdTable<int>::kNoId);
  EXPECT_EQ(table.count(IdTable<int>::kNoId), 0U);
  EXPECT_EQ(table.size(), 1U);
}

}  // namespace
}  // namespace ardrone_vslam
