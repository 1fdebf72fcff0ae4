// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace ardrone_vslam {

/// Measurements r = H x + n of some error coordinates, compressed to H' W H and H' W r.
struct Information {
  std::vector<int> coordinates;  ///< of the state
  Eigen::MatrixXd matrix;        ///< H' W H, as many rows as coordinates
  Eigen::VectorXd vector;        ///< H' W r

  /// Nothing measured yet of these coordinates: zeros.
  explicit Information(std::vector<int> of_coordinates)
      : coordinates(std::move(of_coordinates)),
        matrix(Eigen::MatrixXd::Zero(size(), size())),
        vector(Eigen::VectorXd::Zero(size())) {}

  /// The same of consecutive coordinates: from the first up to, but not with, the end.
  static Information between(int first, int end) {
    std::vector<int> consecutive(static_cast<std::size_t>(end - first));
    std::iota(consecutive.begin(), consecutive.end(), first);
    return Information(std::move(consecutive));
  }

  /// Adds what is measured of N coordinates. `at`: where in this they stand.
  template <int N>
  void add(const std::array<int, std::size_t{N}>& at, const Eigen::Matrix<double, N, N>& HtWH,
           const Eigen::Matrix<double, N, 1>& HtWr) {
    const Eigen::Map<const Eigen::Matrix<int, N, 1>> to(at.data());
    for (int col = 0; col < N; ++col) {
      for (int row = 0; row < N; ++row) matrix(to[row], to[col]) += HtWH(row, col);
      vector[to[col]] += HtWr[col];
    }
  }

  /// Number of coordinates.
  Eigen::Index size() const { return static_cast<Eigen::Index>(coordinates.size()); }
};

}  // namespace ardrone_vslam
