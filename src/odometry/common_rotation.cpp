// SPDX-License-Identifier: BSD-3-Clause
#include "odometry/common_rotation.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

#include "ardrone_vslam/rotation.hpp"

namespace ardrone_vslam {
namespace {

constexpr int kCommonRounds = 4;

}  // namespace

Eigen::Matrix3d commonRotation(const std::vector<BearingPair>& pairs, double least_scale_rad,
                               const Eigen::Vector3d& direction_then) {
  Eigen::Matrix3d R_then_now = Eigen::Matrix3d::Identity();
  double shift = 0;
  double scale_rad = 0;  // in the first round all count alike
  for (int round = 0; round < kCommonRounds; ++round) {
    Eigen::Matrix4d A = Eigen::Matrix4d::Zero();
    Eigen::Vector4d g = Eigen::Vector4d::Zero();
    double sum = 0, sum_left = 0;
    for (const BearingPair& pair : pairs) {
      const Eigen::Vector3d now = R_then_now * pair.now;
      const Eigen::Vector3d moved = now - pair.then;
      const Eigen::Vector3d across = direction_then - now.dot(direction_then) * now;
      const double left = (moved + shift * across).norm();
      const double weight = scale_rad > 0 ? weightOf(left, scale_rad) : 1;
      sum += weight;
      sum_left += weight * left;
      Eigen::Matrix<double, 3, 4> J;
      J << -skew(now), across;
      A += weight * J.transpose() * J;
      g += weight * J.transpose() * moved;
    }
    scale_rad = std::max(2 * sum_left / sum, least_scale_rad);
    const Eigen::Vector4d step = -A.ldlt().solve(g);
    R_then_now = rotationOf(step.head<3>()) * R_then_now;
    shift = step.w();
  }
  return R_then_now;
}

}  // namespace ardrone_vslam
