// SPDX-License-Identifier: BSD-3-Clause
#include "map/landmark_locator.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "linear/median.hpp"
#include "linear/portable_math.hpp"
#include "map/triangulation.hpp"

namespace ardrone_vslam {
namespace {

/// How far a landmark lies off its measured ray from a camera position, in its own sigmas.
double residual(const Observation& s, const Eigen::Vector3d& camera_map, double sigma_a) {
  const Eigen::Vector3d to_landmark = s.landmark_map - camera_map;
  const double d = to_landmark.dot(s.direction_map);
  return (to_landmark - d * s.direction_map).norm() /
         measurementSigma_m(s.landmark_sigma_m, std::abs(d), sigma_a);
}

}  // namespace

LandmarkLocator::LandmarkLocator(const LocatorConfig& config) : config_(config) {
  validate(config);
}

std::optional<PositionFix> LandmarkLocator::locate(const std::vector<Observation>& observations,
                                                   const Eigen::Vector3d& predicted_camera_map,
                                                   double angle_sigma_rad) const {
  if (static_cast<int>(observations.size()) < config_.min_landmarks) return std::nullopt;
  std::optional<PositionFix> fix =
      config_.mean == MeanKind::kPrinted
          ? printedMean(observations, predicted_camera_map, angle_sigma_rad)
          : exactMean(observations, predicted_camera_map, angle_sigma_rad);
  if (!fix || !fix->position_map.allFinite()) return std::nullopt;
  const double floor_m = portable::hypot(
      config_.fix_sigma_floor_m, config_.fix_angle_floor_deg * M_PI / 180 * fix->distance_m);
  fix->covariance += floor_m * floor_m * Eigen::Matrix3d::Identity();
  return fix;
}

std::optional<PositionFix> LandmarkLocator::locate(const std::vector<Association>& matches,
                                                   const FrameView& view, const LandmarkMap& map,
                                                   double angle_sigma_rad) const {
  std::vector<Observation> observations;
  observations.reserve(matches.size());
  for (const Association& match : matches) {
    const Landmark& landmark = map.all()[static_cast<std::size_t>(match.target)];
    observations.push_back({landmark.position_map,
                            view.ray(static_cast<std::size_t>(match.feature)).direction_map,
                            landmark.sigma_m, landmark.position_variance_m2});
  }
  return locate(observations, view.origin_map(), angle_sigma_rad);
}

PositionFix LandmarkLocator::printedMean(const std::vector<Observation>& observations,
                                         const Eigen::Vector3d& predicted, double sigma_a) const {
  PositionFix fix;
  Eigen::Vector3d weighted_sum = Eigen::Vector3d::Zero();
  double weight_sum = 0;
  for (const Observation& s : observations) {
    const double d = (s.landmark_map - predicted).dot(s.direction_map);     // (6.2)
    const Eigen::Vector3d position = s.landmark_map - d * s.direction_map;  // (6.1)
    const double weight =
        1 / measurementSigma_m(s.landmark_sigma_m, std::abs(d), sigma_a);  // (6.3)
    weighted_sum += weight * position;
    fix.shared_variance_m2 += weight * s.position_variance_m2;
    fix.distance_m += weight * std::abs(d);
    weight_sum += weight;
  }
  // The sigma of this mean for independent inputs; (6.5) as printed does not shrink with their
  // number.
  const double sigma = std::sqrt(static_cast<double>(observations.size())) / weight_sum;
  fix.position_map = weighted_sum / weight_sum;  // (6.4)
  fix.covariance = sigma * sigma * Eigen::Matrix3d::Identity();
  fix.shared_variance_m2 /= weight_sum;
  fix.distance_m /= weight_sum;
  return fix;
}

std::optional<PositionFix> LandmarkLocator::exactMean(const std::vector<Observation>& observations,
                                                      const Eigen::Vector3d& predicted,
                                                      double sigma_a) const {
  std::vector<double> trust(observations.size(), 1);
  std::optional<PositionFix> fix = leastSquares(observations, predicted, sigma_a, trust);
  // Iteratively reweighted: wrong matches would draw an undamped mean along with them.
  constexpr int kRounds = 4;
  for (int round = 0; fix && config_.outlier_sigmas > 0 && round < kRounds; ++round) {
    trust = trustIn(observations, fix->position_map, sigma_a);
    fix = leastSquares(observations, predicted, sigma_a, trust);
  }
  return fix;
}

std::vector<double> LandmarkLocator::trustIn(const std::vector<Observation>& observations,
                                             const Eigen::Vector3d& camera_map,
                                             double sigma_a) const {
  std::vector<double> residuals;
  residuals.reserve(observations.size());
  for (const Observation& s : observations) residuals.push_back(residual(s, camera_map, sigma_a));
  std::vector<double> sorted = residuals;
  constexpr double kMedianOfLength = 1.177;  // of a 2-vector of unit sigma per axis
  constexpr double kPerfectFit = 1e-9;
  const double limit =
      config_.outlier_sigmas * std::max(medianOf(sorted) / kMedianOfLength, kPerfectFit);
  for (double& r : residuals) {
    const double squared = r / limit * (r / limit);
    r = 1 / ((1 + squared) * (1 + squared));  // Geman and McClure's weight
  }
  return residuals;
}

std::optional<PositionFix> LandmarkLocator::leastSquares(
    const std::vector<Observation>& observations, const Eigen::Vector3d& predicted, double sigma_a,
    const std::vector<double>& trust) const {
  PositionFix fix;
  double weight_sum = 0;
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d weighted_sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < observations.size(); ++i) {
    const Observation& s = observations[i];
    const double d = (s.landmark_map - predicted).dot(s.direction_map);
    const double sigma = measurementSigma_m(s.landmark_sigma_m, std::abs(d), sigma_a);
    const double weight = trust[i] / (sigma * sigma);
    const Eigen::Matrix3d across =
        weight * (Eigen::Matrix3d::Identity() - s.direction_map * s.direction_map.transpose());
    fix.shared_variance_m2 += weight * s.position_variance_m2;
    fix.distance_m += weight * std::abs(d);
    weight_sum += weight;
    information += across;
    weighted_sum += across * s.landmark_map;
  }
  // Landmarks in one direction alone leave the position along it open.
  constexpr double kSmallestEigenvalueRatio = 1e-6;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(information);
  if (!(eigen.eigenvalues()(0) > kSmallestEigenvalueRatio * eigen.eigenvalues()(2)))
    return std::nullopt;
  fix.covariance = information.inverse();
  fix.position_map = fix.covariance * weighted_sum;
  fix.shared_variance_m2 /= weight_sum;
  fix.distance_m /= weight_sum;
  return fix;
}

}  // namespace ardrone_vslam
