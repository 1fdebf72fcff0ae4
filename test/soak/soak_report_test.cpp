// SPDX-License-Identifier: BSD-3-Clause
// What the soak takes for growth, and what not.
#include "soak/soak_report.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

namespace ardrone_vslam::test {
namespace {

/// A level flight: the first two rows are the warm-up.
std::vector<SoakRow> levelRows() {
  std::vector<SoakRow> rows(8);
  for (SoakRow& row : rows) {
    row.process = {100, 60, 5, 2};
    row.landmarks = 1000;
    row.error_rms_m = 0.1;
    row.nees_per_axis = 1;
  }
  return rows;
}

std::size_t faultsAfter(const std::function<void(SoakRow&)>& change, std::size_t from = 5) {
  std::vector<SoakRow> rows = levelRows();
  for (std::size_t i = from; i < rows.size(); ++i) change(rows[i]);
  return faultsOf(rows, {}).size();
}

TEST(SoakReport, ALevelFlightHasNoFaults) {
  EXPECT_TRUE(faultsOf(levelRows(), {}).empty());
}

TEST(SoakReport, WhatGrowsIsAFault) {
  EXPECT_EQ(faultsAfter([](SoakRow& row) { row.process.heap_mb += 1.1; }), 1U);
  EXPECT_EQ(faultsAfter([](SoakRow& row) { row.process.resident_mb += 4.1; }), 1U);
  EXPECT_EQ(faultsAfter([](SoakRow& row) { row.process.handles += 1; }), 1U);
  EXPECT_EQ(faultsAfter([](SoakRow& row) { row.process.threads += 1; }), 1U);
  EXPECT_EQ(faultsAfter([](SoakRow& row) { row.error_rms_m += 0.2; }), 1U);
  EXPECT_EQ(faultsAfter([](SoakRow& row) { row.nees_per_axis += 2; }), 1U);
}

TEST(SoakReport, AMapMayGrow) {
  const auto grow = [](SoakRow& row) {
    row.landmarks += 1000;
    row.process.heap_mb += 2;
  };
  EXPECT_EQ(faultsAfter(grow), 0U);
}

TEST(SoakReport, WhatIsNotFiniteIsAFault) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(faultsAfter([](SoakRow& row) { row.error_rms_m = kNan; }), 1U);
  EXPECT_EQ(
      faultsAfter(
          [](SoakRow& row) { row.shares[static_cast<std::size_t>(SlamState::kNotFinite)] = 0.1; },
          7),
      1U);
}

TEST(SoakReport, AFewRowsTellNothing) {
  std::vector<SoakRow> rows = levelRows();
  rows.resize(SoakBounds::kLeast - 1);
  EXPECT_EQ(faultsOf(rows, {}).size(), 1U);
}

}  // namespace
}  // namespace ardrone_vslam::test
