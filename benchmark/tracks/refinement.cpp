// SPDX-License-Identifier: BSD-3-Clause
#include "refinement.hpp"

#include <Eigen/Cholesky>
#include <array>
#include <cmath>

#include "ardrone_vslam/rotation.hpp"
#include "robust.hpp"

namespace ardrone_vslam::bench {
namespace {

constexpr int kUnknowns = 8;  // a rotation, a direction's two, and a turn's three along the rows
using Change = Eigen::Matrix<double, kUnknowns, 1>;
using Products = Eigen::Matrix<double, kUnknowns, kUnknowns>;

constexpr double kDifference = 1e-5;  // [rad], of derivatives

RelativePose changed(const RelativePose& pose, const Change& change) {
  const Eigen::Vector3d across = pose.direction_second.unitOrthogonal();
  const Eigen::Vector3d other = pose.direction_second.cross(across);
  RelativePose result;
  result.R_second_first = rotationOf(change.head<3>()) * pose.R_second_first;
  result.direction_second =
      (pose.direction_second + change[3] * across + change[4] * other).normalized();
  result.rotation_per_row = pose.rotation_per_row + change.tail<3>();
  return result;
}

/// Beyond this pairs count less and less.
double scaleOf_px(const RelativePose& pose, const std::vector<PointPair>& pairs) {
  constexpr double kLeast_px = 0.02;
  std::vector<double> distances_px;
  distances_px.reserve(pairs.size());
  for (const PointPair& pair : pairs)
    distances_px.push_back(epipolarDistance(pose, pair).sampson_px);
  return 2 * (sigmaOf(std::move(distances_px)) + kLeast_px);
}

/// Geman and McClure's.
double weightOf(double distance_px, double scale_px) {
  const double ratio = distance_px / scale_px;
  return 1 / std::pow(1 + ratio * ratio, 2);
}

RelativePose stepFrom(const RelativePose& pose, const std::vector<PointPair>& pairs) {
  std::array<RelativePose, kUnknowns> beside;
  for (int i = 0; i < kUnknowns; ++i)
    beside[static_cast<std::size_t>(i)] = changed(pose, kDifference * Change::Unit(i));
  const double scale_px = scaleOf_px(pose, pairs);
  // What the pairs do not tell stays: the direction, where the camera hardly moved.
  constexpr double kStays = 1e-3;
  Products products = kStays * Products::Identity();
  Change sums = Change::Zero();
  for (const PointPair& pair : pairs) {
    const double distance_px = epipolarDistance(pose, pair).sampson_px;
    Change slope;
    for (int i = 0; i < kUnknowns; ++i) {
      const double moved_px =
          epipolarDistance(beside[static_cast<std::size_t>(i)], pair).sampson_px;
      slope[i] = (moved_px - distance_px) / kDifference;
    }
    const double weight = weightOf(distance_px, scale_px);
    products += weight * slope * slope.transpose();
    sums -= weight * distance_px * slope;
  }
  return changed(pose, products.ldlt().solve(sums));
}

}  // namespace

std::optional<RelativePose> refined(const RelativePose& start,
                                    const std::vector<PointPair>& pairs) {
  constexpr std::size_t kFewest = 60;
  constexpr int kSteps = 8;
  if (pairs.size() < kFewest) return std::nullopt;
  RelativePose pose = start;
  for (int i = 0; i < kSteps; ++i) pose = stepFrom(pose, pairs);
  return pose;
}

}  // namespace ardrone_vslam::bench
