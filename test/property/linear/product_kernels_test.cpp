// SPDX-License-Identifier: BSD-3-Clause
#include "kernels/product/product_kernels.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cstring>

#include "kernels/kernels.hpp"
#include "linear/tiled_product.hpp"
#include "support/grey_images.hpp"

namespace ardrone_vslam::test {
namespace {

using kernels::kTileColumns;
using kernels::kTileRows;
using Tile = Eigen::Matrix<float, kTileRows, kTileColumns>;

class ProductKernels : public ::testing::TestWithParam<InstructionSet> {};

TEST_P(ProductKernels, EqualScalarBitForBit) {
  for (const unsigned seed : testSeeds()) {
    SCOPED_TRACE(seed);
    std::srand(seed);
    for (int terms = 0; terms < 100; ++terms) {
      const Eigen::MatrixXf a = Eigen::MatrixXf::Random(kTileRows, terms);
      const Eigen::MatrixXf b = Eigen::MatrixXf::Random(kTileColumns, terms);
      Tile expected;
      Tile found;
      kernels::productTileScalar(a.data(), b.data(), terms, expected.data());
      kernels::kernelsFor(GetParam()).product_tile(a.data(), b.data(), terms, found.data());
      ASSERT_EQ(std::memcmp(expected.data(), found.data(), sizeof(Tile)), 0) << terms;
      ASSERT_LT((found - a * b.transpose()).cwiseAbs().maxCoeff(), 1e-4F) << terms;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sets, ProductKernels, ::testing::ValuesIn(supportedInstructionSets()));

TEST(TiledProduct, IsTheProductForSizesBesideTheTiles) {
  for (int rows = 0; rows < 20; ++rows) {
    for (int columns = 0; columns < 10; ++columns) {
      for (const int terms : {0, 1, 5, 41}) {
        const Eigen::MatrixXf a = Eigen::MatrixXf::Random(rows, terms);
        const Eigen::MatrixXf b = Eigen::MatrixXf::Random(terms, columns);
        const Eigen::MatrixXf product = tiledProduct(a, b);
        ASSERT_EQ(product.rows(), rows);
        ASSERT_EQ(product.cols(), columns);
        EXPECT_TRUE(product.isApprox(a * b, 1e-5F)) << rows << ' ' << columns << ' ' << terms;
      }
    }
  }
}

TEST(TiledProduct, ASymmetricProductIsSubtractedFromAPartOfAMatrixAndLeavesItSymmetric) {
  for (int size = 1; size < 40; ++size) {
    const Eigen::MatrixXd half = Eigen::MatrixXd::Random(size + 2, size + 2);
    const Eigen::MatrixXd before = half + half.transpose();
    const Eigen::MatrixXf g = Eigen::MatrixXf::Random(size, 5);
    const Eigen::MatrixXf t = Eigen::MatrixXf::Random(size, 1);
    const Eigen::MatrixXf v = Eigen::MatrixXf::Random(size, 1);
    Eigen::MatrixXf a(size, 7);
    Eigen::MatrixXf b(size, 7);
    a << g, t, v;
    b << g, v, t;
    Eigen::MatrixXd after = before;
    subtractSymmetricProduct(a, b, after.topLeftCorner(size, size));
    const Eigen::MatrixXd corner = after.topLeftCorner(size, size);
    const Eigen::MatrixXd product = (a * b.transpose()).cast<double>();
    EXPECT_LT((before.topLeftCorner(size, size) - product - corner).cwiseAbs().maxCoeff(), 1e-5);
    EXPECT_EQ(corner, corner.transpose());
    EXPECT_EQ(after.rightCols(2), before.rightCols(2));
    EXPECT_EQ(after.bottomRows(2), before.bottomRows(2));
  }
}

}  // namespace
}  // namespace ardrone_vslam::test
