// SPDX-License-Identifier: BSD-3-Clause
#include "camera/lens_table.hpp"

#include <algorithm>
#include <cmath>

#include "camera/brown_model.hpp"
#include "linear/portable_math.hpp"

namespace ardrone_vslam {
namespace {

// 4 to 64 kB; the AR.Drone's camera takes 256 pieces.
constexpr int kFewestPieces = 64;
constexpr int kMostPieces = 1024;

/// Largest squared distorted radius of the image.
double cornerRadius2(const CameraIntrinsics& c) {
  const double x = std::max(c.cx_px, c.width_px - c.cx_px) / c.fx_px;
  const double y = std::max(c.cy_px, c.height_px - c.cy_px) / c.fy_px;
  return x * x + y * y;
}

/// Of the exact inverse: s and z of LensTable::at, and their slopes over the squared radius.
struct Node {
  Eigen::Array2d value;
  Eigen::Array2d slope;
};

Node exactNode(const CameraIntrinsics& c, double widest, double distorted2) {
  const double r = undistortedRadius(c, std::sqrt(distorted2), widest);
  const double r2 = r * r;
  const double scale = 1 / radialFactor(c, r2);
  const double z = 1 / std::sqrt(1 + r2);
  const double r2_slope = scale / radialSlope(c, r2);
  const double scale_slope = -radialFactorSlope(c, r2) * scale * scale * r2_slope;
  const double z_slope = -0.5 * z * z * z * r2_slope;
  return {{scale * z, z}, {scale_slope * z + scale * z_slope, z_slope}};
}

}  // namespace

LensTable::LensTable(const CameraIntrinsics& intrinsics, double widest) {
  const double corner2 = cornerRadius2(intrinsics);
  const double widest_distorted = widest * radialFactor(intrinsics, widest * widest);
  const double end2 = std::min(corner2, widest_distorted * widest_distorted);
  for (int pieces = kFewestPieces; pieces <= kMostPieces; pieces *= 2) {
    pieces_per_unit_ = pieces / end2;
    pieces_ = build(intrinsics, widest, pieces);
    pieces_used_ = static_cast<double>(pieces_.size());
    if (pieces_used_ == pieces) break;
  }
}

std::vector<LensTable::Piece> LensTable::build(const CameraIntrinsics& c, double widest,
                                               int pieces) const {
  const double width = 1 / pieces_per_unit_;
  const double focal_px = std::sqrt(c.fx_px * c.fy_px);
  const auto goodEnough = [&](const Piece& piece, int i) {
    for (const double share : {0.25, 0.5, 0.75}) {
      const double distorted2 = (i + share) * width;
      const Eigen::Array2d exact = exactNode(c, widest, distorted2).value;
      const Eigen::Array2d error = piece.at(share) - exact;
      const double angle_rad = portable::hypot(std::sqrt(distorted2) * error.x(), error.y());
      if (!(angle_rad * focal_px / (exact.y() * exact.y()) < kTolerance_px)) return false;
    }
    return true;
  };
  std::vector<Piece> made;
  made.reserve(static_cast<std::size_t>(pieces));
  Node left = exactNode(c, widest, 0);
  for (int i = 0; i < pieces; ++i) {
    const Node right = exactNode(c, widest, (i + 1) * width);
    const Eigen::Array2d rise = right.value - left.value;
    const Eigen::Array2d from = width * left.slope;
    const Eigen::Array2d to = width * right.slope;
    Piece piece;
    piece.terms[0] = left.value;
    piece.terms[1] = from;
    piece.terms[2] = 3 * rise - 2 * from - to;
    piece.terms[3] = from + to - 2 * rise;
    if (!goodEnough(piece, i)) break;
    made.push_back(piece);
    left = right;
  }
  return made;
}

}  // namespace ardrone_vslam
