// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace ardrone_vslam {

/// A covariance whose coordinates come and go in place: only what lies behind a change moves, and
/// nothing is allocated once it has been as large. Eigen's conservativeResize moves and allocates
/// all.
class CovarianceMatrix {
 public:
  /// The square of the present size, to be written.
  using View = Eigen::Block<Eigen::MatrixXd>;
  /// And to be read.
  using ConstView = Eigen::Block<const Eigen::MatrixXd>;

  /// Number of coordinates.
  int size() const { return size_; }
  /// All coordinates; good until the size changes.
  View all() { return storage_.topLeftCorner(size_, size_); }
  /// @copydoc all()
  ConstView all() const { return storage_.topLeftCorner(size_, size_); }

  /// Zero, of so many coordinates.
  void reset(int size);
  /// So many zero coordinates more before `at`. O(size * (count + those behind)).
  void insert(int at, int count);
  /// O(size * those behind).
  void remove(int first, int count);
  /// Zero again. O(size * count).
  void clear(int first, int count);
  /// Makes the coordinates from `to` the same variables as those from `from`. O(size * count).
  void copy(int from, int to, int count);

 private:
  Eigen::MatrixXd storage_;
  int size_ = 0;
};

}  // namespace ardrone_vslam
