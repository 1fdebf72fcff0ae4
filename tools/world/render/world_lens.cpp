// SPDX-License-Identifier: BSD-3-Clause
#include "world/render/world_lens.hpp"

#include <Eigen/LU>

namespace ardrone_vslam {
namespace {

/// Brown's model and its Jacobian on the image plane.
Eigen::Vector2d distort(const CameraIntrinsics& c, const Eigen::Vector2d& p, Eigen::Matrix2d& J) {
  const double x = p.x(), y = p.y();
  const double r2 = p.squaredNorm();
  const double radial = 1 + r2 * (c.k1 + r2 * (c.k2 + r2 * c.k3));
  const double slope = c.k1 + r2 * (2 * c.k2 + r2 * 3 * c.k3);  // d radial / d r2
  J << radial + 2 * x * x * slope + 2 * c.p1 * y + 6 * c.p2 * x,
      2 * x * y * slope + 2 * c.p1 * x + 2 * c.p2 * y,
      2 * x * y * slope + 2 * c.p1 * x + 2 * c.p2 * y,
      radial + 2 * y * y * slope + 6 * c.p1 * y + 2 * c.p2 * x;
  return {x * radial + 2 * c.p1 * x * y + c.p2 * (r2 + 2 * x * x),
          y * radial + c.p1 * (r2 + 2 * y * y) + 2 * c.p2 * x * y};
}

}  // namespace

bool exactDirection(const CameraIntrinsics& camera, const Eigen::Vector2d& pixel_px,
                    Eigen::Vector3d& direction_cam) {
  const Eigen::Vector2d distorted((pixel_px.x() - camera.cx_px) / camera.fx_px,
                                  (pixel_px.y() - camera.cy_px) / camera.fy_px);
  // From the middle outwards: the solution is followed continuously and cannot leap over the fold.
  constexpr int kStages = 8;
  Eigen::Vector2d plane = Eigen::Vector2d::Zero();
  Eigen::Matrix2d J;
  for (int stage = 1; stage <= kStages; ++stage) {
    const Eigen::Vector2d target = distorted * (static_cast<double>(stage) / kStages);
    double error = 1;
    for (int iteration = 0; iteration < 20 && error > 1e-13; ++iteration) {
      const Eigen::Vector2d residual = distort(camera, plane, J) - target;
      error = residual.norm();
      if (!(J.determinant() > 0)) return false;
      plane -= J.inverse() * residual;
    }
    if (!(error < 1e-12)) return false;
  }
  direction_cam << plane, 1;
  return true;
}

}  // namespace ardrone_vslam
