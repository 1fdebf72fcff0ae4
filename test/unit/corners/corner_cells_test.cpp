// SPDX-License-Identifier: BSD-3-Clause
#include "corners/corner_cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace ardrone_vslam {
namespace {

Corner corner(int x, int y, int score) {
  return {static_cast<std::int16_t>(x), static_cast<std::int16_t>(y),
          static_cast<std::uint8_t>(score)};
}

/// Four cells of 100 px side by side.
CornerCells fourCells() {
  CornerCells cells;
  cells.reset(400, 100, 100);
  return cells;
}

/// counts[i] corners in cell i, one in each pixel row, scores falling by 1 from `strongest`.
std::vector<Corner> cornersInCells(const std::vector<int>& counts, int strongest) {
  std::vector<Corner> corners;
  for (int y = 0; y < *std::max_element(counts.begin(), counts.end()); ++y) {
    for (int cell = 0; cell < static_cast<int>(counts.size()); ++cell) {
      if (y < counts[static_cast<std::size_t>(cell)])
        corners.push_back(corner(100 * cell + 50, y, strongest - y));
    }
  }
  return corners;
}

std::vector<int> selectedInCells(const std::vector<Corner>& corners, int budget) {
  CornersByCell by_cell;
  std::vector<Corner> selected;
  by_cell.group(corners, fourCells());
  by_cell.select(budget, selected);
  std::vector<int> counts(4, 0);
  for (const Corner& c : selected) ++counts[static_cast<std::size_t>(c.x_px / 100)];
  return counts;
}

TEST(CornerCells, DividesTheImageIntoPartsOfNearlyEqualSize) {
  CornerCells cells;
  cells.reset(1242, 375, 80);
  EXPECT_EQ(cells.columns(), 16);
  EXPECT_EQ(cells.count(), 16 * 5);
  std::vector<int> width(16, 0);
  for (int x = 0; x < 1242; ++x) ++width[static_cast<std::size_t>(cells.columnAt(x))];
  for (const int w : width) EXPECT_TRUE(w == 77 || w == 78) << w;
  EXPECT_EQ(cells.cellAt(0, 0), 0);
  EXPECT_EQ(cells.cellAt(1241, 374), 79);
}

TEST(CornerCells, ImageSmallerThanACellIsOneCell) {
  CornerCells cells;
  cells.reset(7, 9, 4096);
  EXPECT_EQ(cells.count(), 1);
  EXPECT_EQ(cells.cellAt(6, 8), 0);
}

TEST(CornersByCell, TakesAllWithinTheBudget) {
  EXPECT_EQ(selectedInCells(cornersInCells({3, 0, 5, 1}, 90), 9), (std::vector<int>{3, 0, 5, 1}));
}

TEST(CornersByCell, GivesEqualSharesWhereAllHaveEnough) {
  EXPECT_EQ(selectedInCells(cornersInCells({30, 40, 50, 20}, 90), 40),
            (std::vector<int>{10, 10, 10, 10}));
}

TEST(CornersByCell, SharesOutWhatIsLeftOverInEqualParts) {
  EXPECT_EQ(selectedInCells(cornersInCells({2, 40, 50, 0}, 90), 40),
            (std::vector<int>{2, 19, 19, 0}));
  EXPECT_EQ(selectedInCells(cornersInCells({2, 12, 50, 0}, 90), 40),
            (std::vector<int>{2, 12, 26, 0}));
}

TEST(CornersByCell, LastOnesGoToTheStrongest) {
  std::vector<Corner> corners = cornersInCells({9, 9, 9, 9}, 90);
  for (Corner& c : corners) {
    if (c.x_px / 100 == 2) c.score = 120;
  }
  EXPECT_EQ(selectedInCells(corners, 13), (std::vector<int>{3, 3, 4, 3}));
  // Equal strength: the first in raster order.
  EXPECT_EQ(selectedInCells(cornersInCells({9, 9, 9, 9}, 90), 14), (std::vector<int>{4, 4, 3, 3}));
}

TEST(CornersByCell, BudgetBelowTheNumberOfCells) {
  std::vector<Corner> corners = cornersInCells({1, 1, 1, 1}, 90);
  corners[1].score = 100;
  corners[3].score = 95;
  EXPECT_EQ(selectedInCells(corners, 2), (std::vector<int>{0, 1, 0, 1}));
}

TEST(CornersByCell, TakesTheStrongestOfACellAndKeepsRasterOrder) {
  const std::vector<Corner> corners = {corner(10, 1, 20), corner(20, 1, 50), corner(90, 1, 40),
                                       corner(10, 2, 50), corner(30, 2, 40), corner(11, 3, 60)};
  CornersByCell by_cell;
  std::vector<Corner> selected;
  by_cell.group(corners, fourCells());
  EXPECT_EQ(by_cell.count(0), 6);
  EXPECT_EQ(by_cell.corner(0, 0).score, 60);
  EXPECT_EQ(by_cell.corner(0, 1).x_px, 20);
  by_cell.select(4, selected);
  ASSERT_EQ(selected.size(), 4U);
  const int expected_x[] = {20, 90, 10, 11};  // of the two with 40 the first
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(selected[i].x_px, expected_x[i]);
}

TEST(CornersByCell, NoCorners) {
  EXPECT_EQ(selectedInCells(cornersInCells({0, 0, 0, 0}, 90), 5), std::vector<int>(4, 0));
}

}  // namespace
}  // namespace ardrone_vslam
