// SPDX-License-Identifier: BSD-3-Clause
#include "map_update/observation_rays.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cstdint>
#include <random>

#include "support/seeds.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kRaySigma_rad = 0.001;

/// Of the part of the ray across the landmark's direction, in any two axes.
double mahalanobis(const MapObservation& observation, const Eigen::Vector3d& ray,
                   const Eigen::Vector3d& camera) {
  const Eigen::Vector3d offset = observation.point_map - camera;
  const Eigen::Vector3d direction = offset.normalized();
  Eigen::Matrix<double, 3, 2> axes;
  axes << direction.unitOrthogonal(), direction.cross(direction.unitOrthogonal());
  const Eigen::Matrix3d covariance =
      (kRaySigma_rad * kRaySigma_rad + kSlack_rad * kSlack_rad) * Eigen::Matrix3d::Identity() +
      observation.covariance_m2 / offset.squaredNorm();
  const Eigen::Vector2d off = axes.transpose() * ray;
  return off.dot((axes.transpose() * covariance * axes).inverse() * off);
}

TEST(OffRay, IsTheSquaredDeviationUpToWhatAgrees) {
  for (const std::uint64_t seed : test::seeds()) {
    std::mt19937_64 numbers(seed);
    std::uniform_real_distribution<double> any(-1, 1);
    const auto vector = [&] { return Eigen::Vector3d(any(numbers), any(numbers), any(numbers)); };
    int agreeing = 0;
    for (int i = 0; i < 2000; ++i) {
      MapObservation observation;
      observation.point_map = 3 * vector();
      Eigen::Matrix3d root;
      root << vector(), vector(), vector();
      observation.covariance_m2 = 0.001 * root * root.transpose();
      const Eigen::Vector3d camera = observation.point_map + vector().normalized() * 2;
      const Eigen::Vector3d ray =
          ((observation.point_map - camera).normalized() + 0.02 * vector()).normalized();
      const double expected = mahalanobis(observation, ray, camera);
      const double off = offRay(observation, ray, camera, kRaySigma_rad, kSlack_rad);
      if (expected < kInlier) {
        ++agreeing;
        EXPECT_NEAR(off, expected, 1e-6 * (1 + expected));
      } else {
        EXPECT_GE(off, kInlier * (1 - 1e-9));
        EXPECT_LE(off, expected * (1 + 1e-6));
      }
    }
    EXPECT_GT(agreeing, 1000);
    EXPECT_LT(agreeing, 1900);
  }
}

TEST(OffRay, AnUnknownDepthExcusesNothingBesideIt) {
  // Seen along x before, half a metre deep; now from a side.
  MapObservation observation;
  observation.point_map << 2, 0, 0;
  observation.covariance_m2 = Eigen::Vector3d(0.25, 1e-6, 1e-6).asDiagonal();
  const Eigen::Vector3d camera(2, -2, 0);
  const auto off = [&](const Eigen::Vector3d& aside) {
    const Eigen::Vector3d ray = (observation.point_map + aside - camera).normalized();
    return offRay(observation, ray, camera, kRaySigma_rad, kSlack_rad);
  };
  EXPECT_LT(off({0.3, 0, 0}), 1);
  EXPECT_GT(off({0, 0, 0.05}), kInlier);
  EXPECT_EQ(off({0, 0, 0}), 0);
}

}  // namespace
}  // namespace ardrone_vslam
