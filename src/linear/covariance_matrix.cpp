// SPDX-License-Identifier: BSD-3-Clause
#include "linear/covariance_matrix.hpp"

#include <algorithm>

namespace ardrone_vslam {

void CovarianceMatrix::reset(int size) {
  size_ = 0;
  insert(0, size);
}

void CovarianceMatrix::insert(int at, int count) {
  const int old_size = size_;
  size_ += count;
  if (size_ > storage_.rows()) {
    const int room = size_ + size_ / 2;
    storage_.conservativeResize(room, room);
  }
  // Backwards, so that nothing is written over before it has been moved.
  for (int column = old_size - 1; column >= 0; --column) {
    const double* from = storage_.col(column).data();
    double* to = storage_.col(column < at ? column : column + count).data();
    std::copy_backward(from + at, from + old_size, to + size_);
    if (to != from) std::copy(from, from + at, to);
  }
  clear(at, count);
}

void CovarianceMatrix::clear(int first, int count) {
  all().middleRows(first, count).setZero();
  all().middleCols(first, count).setZero();
}

void CovarianceMatrix::remove(int first, int count) {
  const int behind = first + count;
  for (int column = 0; column < size_; ++column) {
    if (column >= first && column < behind) continue;
    const double* from = storage_.col(column).data();
    double* to = storage_.col(column < first ? column : column - count).data();
    if (to != from) std::copy(from, from + first, to);
    std::copy(from + behind, from + size_, to + first);
  }
  size_ -= count;
}

void CovarianceMatrix::copy(int from, int to, int count) {
  all().middleCols(to, count) = all().middleCols(from, count);
  all().middleRows(to, count) = all().middleRows(from, count);
}

}  // namespace ardrone_vslam
