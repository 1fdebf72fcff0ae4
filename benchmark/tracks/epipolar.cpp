// SPDX-License-Identifier: BSD-3-Clause
#include "epipolar.hpp"

#include <cmath>

#include "ardrone_vslam/rotation.hpp"

namespace ardrone_vslam::bench {

std::optional<PlanePoint> planePointOf(const CameraModel& camera, const Eigen::Vector2d& pixel_px) {
  constexpr double kStep_px = 0.5;
  PlanePoint point;
  const auto bearing = camera.bearing(pixel_px);
  if (!bearing) return std::nullopt;
  point.plane = bearing->hnormalized();
  for (int axis = 0; axis < 2; ++axis) {
    const Eigen::Vector2d step_px = kStep_px * Eigen::Vector2d::Unit(axis);
    const auto after = camera.bearing(pixel_px + step_px);
    const auto before = camera.bearing(pixel_px - step_px);
    if (!after || !before) return std::nullopt;
    point.plane_per_px.col(axis) = (after->hnormalized() - before->hnormalized()) / (2 * kStep_px);
  }
  return point;
}

Eigen::Matrix3d RelativePose::essential(double row_second) const {
  return skew(direction_second) * rotationOf(row_second * rotation_per_row) * R_second_first;
}

EpipolarDistance epipolarDistance(const RelativePose& pose, const PointPair& pair) {
  const Eigen::Matrix3d essential = pose.essential(pair.second.plane.y());
  const Eigen::Vector3d first = pair.first.plane.homogeneous();
  const Eigen::Vector3d second = pair.second.plane.homogeneous();
  const Eigen::Vector3d line_second = essential * first;
  const Eigen::Vector3d line_first = essential.transpose() * second;
  // What a pixel changes of `miss`, in each image.
  const Eigen::Vector2d slope_second = pair.second.plane_per_px.transpose() * line_second.head<2>();
  const Eigen::Vector2d slope_first = pair.first.plane_per_px.transpose() * line_first.head<2>();
  const double miss = second.dot(line_second);
  EpipolarDistance distance;
  distance.sampson_px = miss / std::sqrt(slope_second.squaredNorm() + slope_first.squaredNorm());
  distance.second_px = miss / slope_second.norm();
  distance.normal = slope_second.normalized();
  return distance;
}

}  // namespace ardrone_vslam::bench
