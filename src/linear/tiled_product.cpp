// SPDX-License-Identifier: BSD-3-Clause
#include "linear/tiled_product.hpp"

#include <algorithm>

#include "kernels/kernels.hpp"

namespace ardrone_vslam {
namespace {

using kernels::kTileColumns;
using kernels::kTileRows;
using Tile = Eigen::Matrix<float, kTileRows, kTileColumns>;

/// The rows of a matrix in panels of as many as a tile has, one term of the products after the
/// other, so that the kernel reads straight on. Rows beyond the last are zero.
template <int kHeight>
class Panels {
 public:
  template <class Rows>
  explicit Panels(const Rows& matrix) : terms_(matrix.cols()) {
    const Eigen::Index whole = matrix.rows() / kHeight * kHeight;
    const Eigen::Index rest = matrix.rows() - whole;
    values_.resize(kHeight, (whole + (rest > 0 ? kHeight : 0)) / kHeight * terms_);
    for (Eigen::Index row = 0; row < whole; row += kHeight)
      values_.middleCols(row / kHeight * terms_, terms_) = matrix.template middleRows<kHeight>(row);
    if (rest == 0) return;
    auto last = values_.rightCols(terms_);
    last.topRows(rest) = matrix.bottomRows(rest);
    last.bottomRows(kHeight - rest).setZero();
  }

  /// The panel that begins with a row.
  const float* at(Eigen::Index row) const { return values_.data() + row * terms_; }
  int terms() const { return static_cast<int>(terms_); }

 private:
  Eigen::Index terms_;
  Eigen::Matrix<float, kHeight, Eigen::Dynamic> values_;
};

}  // namespace

Eigen::MatrixXf tiledProduct(const Eigen::MatrixXf& a, const Eigen::MatrixXf& b) {
  const auto productTile = kernels::kernelsInUse().product_tile;
  const Panels<kTileRows> left(a);
  const Panels<kTileColumns> right(b.transpose());
  Eigen::MatrixXf product(a.rows(), b.cols());
  Tile tile;
  for (Eigen::Index column = 0; column < b.cols(); column += kTileColumns) {
    const Eigen::Index width = std::min<Eigen::Index>(kTileColumns, b.cols() - column);
    for (Eigen::Index row = 0; row < a.rows(); row += kTileRows) {
      const Eigen::Index height = std::min<Eigen::Index>(kTileRows, a.rows() - row);
      productTile(left.at(row), right.at(column), left.terms(), tile.data());
      if (height == kTileRows && width == kTileColumns)
        product.block<kTileRows, kTileColumns>(row, column) = tile;
      else
        product.block(row, column, height, width) = tile.topLeftCorner(height, width);
    }
  }
  return product;
}

void subtractSymmetricProduct(const Eigen::MatrixXf& a, const Eigen::MatrixXf& b,
                              Eigen::Block<Eigen::MatrixXd> P) {
  const auto productTile = kernels::kernelsInUse().product_tile;
  const Panels<kTileRows> left(a);
  const Panels<kTileColumns> right(b);
  const Eigen::Index size = P.rows();
  Tile tile;
  for (Eigen::Index column = 0; column < size; column += kTileColumns) {
    for (Eigen::Index row = column / kTileRows * kTileRows; row < size; row += kTileRows) {
      productTile(left.at(row), right.at(column), left.terms(), tile.data());
      if (row >= column + kTileColumns && row + kTileRows <= size) {
        auto below = P.block<kTileRows, kTileColumns>(row, column);
        below -= tile.cast<double>();
        P.block<kTileColumns, kTileRows>(column, row) = below.transpose();
        continue;
      }
      // On the diagonal or at the edge.
      for (Eigen::Index j = column; j < std::min(column + kTileColumns, size); ++j) {
        for (Eigen::Index i = std::max(row, j); i < std::min(row + kTileRows, size); ++i)
          P(j, i) = P(i, j) -= static_cast<double>(tile(i - row, j - column));
      }
    }
  }
}

}  // namespace ardrone_vslam
