// SPDX-License-Identifier: BSD-3-Clause
#include "thesis/thesis_filter.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "linear/scalars.hpp"

namespace ardrone_vslam {
namespace {

/// The part of a covariance that exceeds `shared_m2`, along each of its principal axes.
Eigen::Matrix3d excess(const Eigen::Matrix3d& covariance, double shared_m2) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(covariance);
  const Eigen::Vector3d above = (eigen.eigenvalues().array() - shared_m2).max(0.0);
  return eigen.eigenvectors() * above.asDiagonal() * eigen.eigenvectors().transpose();
}

}  // namespace

ThesisFilter::ThesisFilter(const ThesisFilterConfig& config) : config_(config) {
  validate(config);
}

void ThesisFilter::start(const Eigen::Vector3d& position_map, const OdometryState& odometry) {
  odometry_ = odometry;
  position_map_ = position_map;
  covariance_ = config_.initial_sigma_m * config_.initial_sigma_m * Eigen::Matrix3d::Identity();
}

void ThesisFilter::predict(const OdometryState& odometry) {
  const Eigen::Vector3d increment =
      odometry.T_odom_base.translation() - odometry_.T_odom_base.translation();
  const double passed_s = seconds(odometry.stamp_ns - odometry_.stamp_ns);
  constexpr double kRounding = 1e-12;  // a constant covariance does not grow by its rounding
  const std::optional<double> then = positionVariance_m2(odometry_);
  const std::optional<double> now = positionVariance_m2(odometry);
  double variance = 0;
  if (then && now && *now - *then > kRounding * *then) {
    variance = *now - *then;
  } else {
    variance = config_.odometry_noise_m_per_sqrt_m * config_.odometry_noise_m_per_sqrt_m *
                   increment.norm() +
               config_.odometry_noise_m_per_sqrt_s * config_.odometry_noise_m_per_sqrt_s *
                   std::max(passed_s, 0.0);
  }
  position_map_ += increment;
  covariance_ += variance * Eigen::Matrix3d::Identity();
  odometry_ = odometry;
}

bool ThesisFilter::fuse(const PositionFix& fix) {
  // Lesson 4: the landmarks share the error that the pose had when they were made; the fix only
  // speaks of the drift since.
  const Eigen::Matrix3d drift =
      config_.common_drift ? excess(covariance_, fix.shared_variance_m2) : covariance_;
  const Eigen::Matrix3d shared = covariance_ - drift;
  const Eigen::Vector3d innovation = fix.position_map - position_map_;  // (6.8)
  const Eigen::Matrix3d inverse = (drift + fix.covariance).inverse();   // (6.9)
  const double gate = config_.gate_sigmas * config_.gate_sigmas;
  if (!(innovation.dot(inverse * innovation) <= gate)) return false;  // nor what is not finite
  const Eigen::Matrix3d gain = drift * inverse;                       // (6.10)
  position_map_ += gain * innovation;                                 // (6.11)
  const Eigen::Matrix3d rest = Eigen::Matrix3d::Identity() - gain;
  // Joseph form of (6.12): symmetric and positive whatever the rounding.
  covariance_ = shared + rest * drift * rest.transpose() + gain * fix.covariance * gain.transpose();
  covariance_ = (0.5 * (covariance_ + covariance_.transpose())).eval();
  return true;
}

double ThesisFilter::sigma_m() const {
  return std::sqrt(covariance_.trace() / 3);
}

}  // namespace ardrone_vslam
