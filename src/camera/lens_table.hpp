// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "ardrone_vslam/camera_model.hpp"

namespace ardrone_vslam {

/// Inverse of Brown's radial model, tabulated over the squared distorted radius, so that a look-up
/// needs neither a root nor a division: cubic pieces through values and slopes of the exact
/// inverse. Ends where the image does, or before that where the pieces are no longer good enough:
/// short of the fold, where the inverse turns vertical.
class LensTable {
 public:
  /// Largest error of a direction, as seen on the image plane, at the places that are tried while
  /// the table is built.
  static constexpr double kTolerance_px = 1e-7;

  /// @param widest  undistorted radius up to which the model is monotonic
  LensTable(const CameraIntrinsics& intrinsics, double widest);

  bool covers(double distorted2) const { return distorted2 * pieces_per_unit_ < pieces_used_; }

  /// The unit direction of the distorted point (x, y) is (x s, y s, z).
  /// @return s, z
  /// @param distorted2  x^2 + y^2, covered
  Eigen::Array2d at(double distorted2) const {
    const double position = distorted2 * pieces_per_unit_;
    const int i = static_cast<int>(position);
    const Eigen::Array2d found = pieces_[static_cast<std::size_t>(i)].at(position - i);
    // Unit to the last bits by one step towards 1 / sqrt(length^2), which is 1 within 1e-9.
    const double length2 = distorted2 * found.x() * found.x() + found.y() * found.y();
    return found * (1.5 - 0.5 * length2);
  }

 private:
  struct alignas(64) Piece {
    Eigen::Array2d terms[4];

    Eigen::Array2d at(double share) const {
      return terms[0] + share * (terms[1] + share * (terms[2] + share * terms[3]));
    }
  };

  std::vector<Piece> build(const CameraIntrinsics& intrinsics, double widest, int pieces) const;

  std::vector<Piece> pieces_;
  double pieces_per_unit_ = 0;
  double pieces_used_ = 0;
};

}  // namespace ardrone_vslam
