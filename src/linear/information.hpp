// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
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

  /// Number of coordinates.
  Eigen::Index size() const { return static_cast<Eigen::Index>(coordinates.size()); }
};

}  // namespace ardrone_vslam
