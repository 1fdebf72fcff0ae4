// SPDX-License-Identifier: BSD-3-Clause
#include "linear/selection.hpp"

#include <gtest/gtest.h>

#include "linear/information.hpp"

namespace ardrone_vslam {
namespace {

TEST(Selection, TakesRowsAndColumnsInTheOrderAsked) {
  const Eigen::MatrixXd matrix = Eigen::MatrixXd::Random(5, 4);
  const std::vector<int> some = {3, 0, 3};
  const auto rows = rowsOf(matrix, some);
  const auto cols = colsOf(matrix, some);
  ASSERT_EQ(rows.rows(), 3);
  ASSERT_EQ(cols.cols(), 3);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(rows.row(i), matrix.row(some[static_cast<std::size_t>(i)]));
    EXPECT_EQ(cols.col(i), matrix.col(some[static_cast<std::size_t>(i)]));
  }
  EXPECT_EQ(rowsOf(matrix.diagonal(), {2}), matrix.diagonal().segment<1>(2));
  EXPECT_EQ(rowsOf(matrix, {}).size(), 0);
}

TEST(Selection, InformationIsAddedWhereItsCoordinatesStand) {
  Information information({7, 8, 9, 10});
  const Eigen::Matrix2d HtWH = (Eigen::Matrix2d() << 4, 1, 2, 3).finished();
  const Eigen::Vector2d HtWr(5, 6);
  information.add<2>({3, 1}, HtWH, HtWr);
  information.add<2>({3, 1}, HtWH, HtWr);
  Eigen::Matrix4d selection = Eigen::Matrix4d::Zero();
  selection(3, 0) = selection(1, 1) = 1;
  const Eigen::Matrix<double, 4, 2> places = selection.leftCols<2>();
  EXPECT_EQ(information.matrix, 2 * places * HtWH * places.transpose());
  EXPECT_EQ(information.vector, 2 * places * HtWr);
}

}  // namespace
}  // namespace ardrone_vslam
