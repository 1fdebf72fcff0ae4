// SPDX-License-Identifier: BSD-3-Clause
#include "trajectory/metrics.hpp"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cassert>
#include <cmath>

namespace ardrone_vslam {

std::vector<double> positionErrors_m(const Trajectory& estimate, const Trajectory& truth) {
  assert(estimate.size() == truth.size() && "trajectories must have equal stamps");
  std::vector<double> errors;
  errors.reserve(estimate.size());
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    errors.push_back((estimate.poses()[i].T_frame_body.translation() -
                      truth.poses()[i].T_frame_body.translation())
                         .norm());
  }
  return errors;
}

ErrorSummary summarise(const std::vector<double>& errors_m) {
  ErrorSummary summary;
  if (errors_m.empty()) return summary;
  double squares = 0;
  for (const double error : errors_m) {
    squares += error * error;
    summary.mean_m += error;
    summary.max_m = std::max(summary.max_m, error);
  }
  const auto count = static_cast<double>(errors_m.size());
  summary.mean_m /= count;
  summary.rmse_m = std::sqrt(squares / count);
  return summary;
}

double alignedRmse_m(const Trajectory& estimate, const Trajectory& truth) {
  assert(estimate.size() == truth.size() && "trajectories must have equal stamps");
  if (truth.empty()) return 0;
  const auto count = static_cast<Eigen::Index>(truth.size());
  Eigen::Matrix3Xd from(3, count);
  Eigen::Matrix3Xd to(3, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    from.col(i) = estimate.poses()[static_cast<std::size_t>(i)].T_frame_body.translation();
    to.col(i) = truth.poses()[static_cast<std::size_t>(i)].T_frame_body.translation();
  }
  const Eigen::Isometry3d T_truth_estimate(Eigen::umeyama(from, to, false));
  const Eigen::Matrix3Xd left = (T_truth_estimate * from) - to;
  return std::sqrt(left.colwise().squaredNorm().mean());
}

Trajectory scaled(const Trajectory& truth, double scale_error) {
  if (truth.empty()) return {};
  const Eigen::Vector3d start = truth.poses().front().T_frame_body.translation();
  std::vector<StampedPose> poses = truth.poses();
  for (StampedPose& pose : poses) {
    const Eigen::Vector3d position = pose.T_frame_body.translation();
    pose.T_frame_body.translation() = start + (1 + scale_error) * (position - start);
  }
  return Trajectory(std::move(poses));
}

std::vector<double> distancesAlong_m(const Trajectory& path) {
  std::vector<double> travelled_m{0};
  for (std::size_t i = 1; i < path.size(); ++i) {
    travelled_m.push_back(travelled_m.back() + (path.poses()[i].T_frame_body.translation() -
                                                path.poses()[i - 1].T_frame_body.translation())
                                                   .norm());
  }
  return travelled_m;
}

std::optional<double> translationError_percent(const Trajectory& estimate,
                                               const Trajectory& truth) {
  assert(estimate.size() == truth.size() && "trajectories must have equal stamps");
  const std::vector<double> travelled_m = distancesAlong_m(truth);
  constexpr std::size_t kStartStep = 10;
  double sum = 0;
  int count = 0;
  for (std::size_t first = 0; first < truth.size(); first += kStartStep) {
    for (double length_m = 100; length_m <= 800; length_m += 100) {
      const auto end = std::upper_bound(travelled_m.begin() + static_cast<std::ptrdiff_t>(first),
                                        travelled_m.end(), travelled_m[first] + length_m);
      if (end == travelled_m.end()) break;
      const auto last = static_cast<std::size_t>(end - travelled_m.begin());
      const Eigen::Isometry3d true_motion =
          truth.poses()[first].T_frame_body.inverse() * truth.poses()[last].T_frame_body;
      const Eigen::Isometry3d motion =
          estimate.poses()[first].T_frame_body.inverse() * estimate.poses()[last].T_frame_body;
      sum += (motion.inverse() * true_motion).translation().norm() / length_m;
      ++count;
    }
  }
  if (count == 0) return std::nullopt;
  return 100 * sum / count;
}

double nees(const Eigen::Vector3d& error_m, const Eigen::Matrix3d& covariance) {
  return error_m.dot(covariance.inverse() * error_m);
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const double place = share * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  const double part = place - static_cast<double>(below);
  return (1 - part) * values[below] + part * values[above];
}

}  // namespace ardrone_vslam
