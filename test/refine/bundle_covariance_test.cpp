// SPDX-License-Identifier: BSD-3-Clause
#include "refine/bundle_covariance.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <random>

#include "recorded_flight.hpp"
#include "refine/refinement.hpp"
#include "refine/residuals.hpp"

namespace ardrone_vslam {
namespace {

constexpr int kCameras = 4;
constexpr int kPoints = 5;
constexpr Eigen::Index kBlock = 3;

/// Cameras and points of which each pair has a residual along each axis.
struct LinearBundle {
  ceres::Problem problem;
  std::array<std::array<double, 3>, kCameras> cameras{};
  std::array<std::array<double, 3>, kPoints> points{};
  Eigen::MatrixXd normal =
      Eigen::MatrixXd::Zero(kBlock * (kCameras + kPoints), kBlock*(kCameras + kPoints));

  LinearBundle() {
    std::mt19937 generator(3);
    std::uniform_real_distribution<double> between(0.2, 2);
    for (int c = 0; c < kCameras; ++c) {
      for (int p = 0; p < kPoints; ++p) {
        const SlowErrorResidual residual{{between(generator), between(generator), 1},
                                         {between(generator), between(generator), 1}};
        problem.AddResidualBlock(costOf<SlowErrorResidual, 3, 3, 3>(residual), nullptr,
                                 cameras.at(c).data(), points.at(p).data());
        for (int axis = 0; axis < kBlock; ++axis) {
          Eigen::VectorXd row = Eigen::VectorXd::Zero(normal.cols());
          row[kBlock * c + axis] = -residual.keep[axis] / residual.sigma[axis];
          row[kBlock * (kCameras + p) + axis] = 1 / residual.sigma[axis];
          normal += row * row.transpose();
        }
      }
    }
    problem.AddResidualBlock(costOf<PriorResidual<3>, 3, 3>({{0.5, 0.25, 2}}), nullptr,
                             cameras[0].data());
    normal.diagonal().head<3>() += Eigen::Vector3d(4, 16, 0.25);
  }
  std::vector<double*> pointBlocks() {
    std::vector<double*> blocks;
    for (auto& point : points) blocks.push_back(point.data());
    return blocks;
  }
};

TEST(BundleCovariance, IsThePartOfTheWholeInverse) {
  LinearBundle bundle;
  const Eigen::MatrixXd inverse = bundle.normal.inverse();
  const Eigen::MatrixXd P =
      covarianceOf(bundle.problem, {bundle.cameras[2].data(), bundle.cameras[0].data()},
                   {bundle.cameras[3].data()}, bundle.pointBlocks());
  ASSERT_EQ(P.rows(), 6);
  EXPECT_TRUE((P.block<3, 3>(0, 0).isApprox(inverse.block<3, 3>(6, 6), 1e-9)));
  EXPECT_TRUE((P.block<3, 3>(3, 3).isApprox(inverse.block<3, 3>(0, 0), 1e-9)));
  EXPECT_TRUE((P.block<3, 3>(3, 0).isApprox(inverse.block<3, 3>(0, 6), 1e-9)));
}

/// Squared errors of a refined position over what the covariance says; 3 is honest.
double nees(const Refinement& refined, std::size_t anchor, std::size_t keyframe,
            const test::RecordedFlight& flight) {
  const Eigen::Vector3d off_m =
      refined.T_map_base[keyframe].translation() - flight.truth[keyframe].translation();
  const auto at = SavedMap::kAnchor * static_cast<Eigen::Index>(anchor);
  return off_m.dot(refined.anchor_covariance.block<3, 3>(at, at).inverse() * off_m);
}

TEST(BundleCovariance, IsAsLargeAsTheErrorsOfFlights) {
  constexpr std::array<std::size_t, 4> kAnchors{15, 30, 45, 79};
  double sum = 0;
  constexpr int kFlights = 12;
  constexpr double kScale = 0.03;
  constexpr double kBias_m_s = 0.01;
  for (unsigned seed = 1; seed <= kFlights; ++seed) {
    std::mt19937 generator(seed);
    std::normal_distribution<double> normal;
    test::FlightErrors errors;
    errors.corner_px = 0.5;
    errors.scale = 1 + kScale * normal(generator);
    errors.way_m = 0.01;
    for (double& bias : errors.bias_m_s) bias = kBias_m_s * normal(generator);
    test::RecordedFlight flight(errors, seed);
    MsckfConfig& config = flight.record.config;
    config.track_common_px = 0;
    config.odometry.scale_sigma = kScale;
    config.odometry.velocity_bias_m_s = kBias_m_s;
    config.odometry.tilt_sigma_deg = config.odometry.attitude_noise_deg = 0.01;
    config.odometry.yaw_walk_deg_per_sqrt_s = config.odometry.yaw_walk_deg_per_sqrt_m = 1e-3;
    std::vector<MapAnchor> anchors(kAnchors.size());
    for (std::size_t i = 0; i < anchors.size(); ++i)
      anchors[i].stamp_ns = flight.record.keyframes[kAnchors.at(i)].stamp_ns + 100;
    const Refinement refined = refine(flight.record, anchors);
    for (std::size_t i = 0; i < anchors.size(); ++i)
      sum += nees(refined, i, kAnchors.at(i), flight);
  }
  const double mean = sum / (kFlights * kAnchors.size());
  // 1.3 measured: a landmark is taken as known less well than here.
  EXPECT_GT(mean, 0.6);
  EXPECT_LT(mean, 2.4);
}

/// Views are weighed by a part of what they share; how well the result is known follows from all.
TEST(BundleCovariance, GrowsWithWhatTheViewsShare) {
  test::FlightErrors errors;
  errors.corner_px = 0.5;
  errors.way_m = 0.01;
  test::RecordedFlight flight(errors);
  std::vector<MapAnchor> anchors(1);
  constexpr std::size_t kAnchor = 45;
  anchors[0].stamp_ns = flight.record.keyframes[kAnchor].stamp_ns + 100;
  flight.record.config.track_common_px = 0.7;
  const Refinement room = refine(flight.record, anchors);
  flight.record.config.track_common_px = 3.5;
  const Refinement street = refine(flight.record, anchors);
  EXPECT_TRUE(street.T_map_base[kAnchor].isApprox(room.T_map_base[kAnchor], 1e-9));
  for (int axis = 0; axis < 6; ++axis)  // measured: 1.25 or more
    EXPECT_GT(street.anchor_covariance(axis, axis), 1.15 * room.anchor_covariance(axis, axis))
        << axis;
}

}  // namespace
}  // namespace ardrone_vslam
