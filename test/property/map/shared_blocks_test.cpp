// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/shared_blocks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <future>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

namespace ardrone_vslam {
namespace {

using Numbers = SharedBlocks<int, 8>;

std::vector<int> valuesOf(const Numbers& numbers) {
  return {numbers.begin(), numbers.end()};
}

/// One random change, of both.
void changeSomething(std::mt19937& random, Numbers& numbers, std::vector<int>& expected) {
  const auto value = static_cast<int>(random());
  switch (expected.empty() ? 0 : random() % 4) {
    case 0:
    case 1:
      numbers.push_back(value);
      expected.push_back(value);
      break;
    case 2:
      numbers.pop_back();
      expected.pop_back();
      break;
    default:
      const std::size_t at = random() % expected.size();
      numbers.change(at) = expected[at] = value;
  }
}

TEST(SharedBlocks, CopiesStayWhatTheyWere) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    Numbers numbers;
    std::vector<int> expected;
    std::vector<std::pair<Numbers, std::vector<int>>> copies;
    for (int step = 0; step < 2000; ++step) {
      if (random() % 20 == 0) copies.emplace_back(numbers, expected);
      if (random() % 40 == 0 && !copies.empty())
        copies.erase(copies.begin() + static_cast<long>(copies.size() / 2));
      if (random() % 100 == 0 && !copies.empty()) {  // goes on as one of them
        numbers = copies.back().first;
        expected = copies.back().second;
      }
      changeSomething(random, numbers, expected);
      if (!copies.empty() && random() % 10 == 0)
        changeSomething(random, copies.front().first, copies.front().second);
    }
    EXPECT_EQ(valuesOf(numbers), expected) << seed;
    EXPECT_GT(copies.size(), 5U);
    for (const auto& [copy, before] : copies) EXPECT_EQ(valuesOf(copy), before) << seed;
  }
}

TEST(SharedBlocks, AChangeCopiesOneBlock) {
  Numbers numbers(std::vector<int>(100, 1));
  const Numbers copy = numbers;
  numbers.change(20) = 2;
  for (std::size_t i = 0; i < numbers.size(); ++i)
    EXPECT_EQ(&numbers[i] != &copy[i], i / 8 == 2) << i;
  const int* own = &numbers[20];
  numbers.change(21) = 3;
  EXPECT_EQ(&numbers[20], own) << "only once";
}

TEST(SharedBlocks, GrowingMovesNothing) {
  Numbers numbers{1, 2, 3};
  const int* first = &numbers.front();
  for (int i = 0; i < 1000; ++i) numbers.push_back(i);
  EXPECT_EQ(first, &numbers.front());
  EXPECT_THROW(static_cast<void>(numbers.at(1003)), std::out_of_range);
}

TEST(SharedBlocks, IteratorsGoAnywhere) {
  std::vector<int> values(50);
  std::iota(values.begin(), values.end(), 0);
  const Numbers numbers(values);
  EXPECT_EQ(*std::lower_bound(numbers.begin(), numbers.end(), 33), 33);
  EXPECT_EQ(numbers.end() - numbers.begin(), 50);
  EXPECT_EQ(numbers.begin()[17], 17);
  EXPECT_EQ(*(numbers.end() - 1), numbers.back());
}

TEST(SharedBlocks, CanBeMovedAndCleared) {
  Numbers numbers{1, 2, 3};
  Numbers other = std::move(numbers);
  EXPECT_EQ(valuesOf(other), (std::vector<int>{1, 2, 3}));
  const Numbers copy = other;
  other.clear();
  EXPECT_TRUE(other.empty());
  other.push_back(4);
  EXPECT_EQ(valuesOf(other), (std::vector<int>{4}));
  EXPECT_EQ(valuesOf(copy), (std::vector<int>{1, 2, 3}));
}

/// For the thread sanitizer, too.
TEST(SharedBlocks, AnotherThreadReadsACopy) {
  constexpr int kCount = 10'000;
  Numbers numbers(std::vector<int>(kCount, 1));
  for (int round = 0; round < 20; ++round) {
    auto sum = std::async(std::launch::async, [copy = numbers] {
      return std::accumulate(copy.begin(), copy.end(), 0);
    });
    for (std::size_t i = 0; i < numbers.size(); ++i) ++numbers.change(i);
    EXPECT_EQ(sum.get(), kCount * (round + 1));
  }
}

}  // namespace
}  // namespace ardrone_vslam
