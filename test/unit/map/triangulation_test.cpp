// SPDX-License-Identifier: BSD-3-Clause
#include "map/triangulation.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "simulation/random_source.hpp"

namespace ardrone_vslam {
namespace {

Ray rayTo(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  return {from, (to - from).normalized()};
}

TEST(Triangulate, RaysThatMeetGiveTheirPoint) {
  const Eigen::Vector3d point(4, 1, -0.5);
  const Ray first = rayTo({0, 0, 0}, point);
  const Ray present = rayTo({0.5, -1, 0.2}, point);
  const auto found = triangulate(first, present);
  ASSERT_TRUE(found);
  EXPECT_LT((found->position_map - point).norm(), 1e-12);
  EXPECT_NEAR(found->depth_m, (point - present.origin_map).norm(), 1e-12);
  EXPECT_NEAR(found->parallax_rad, std::acos(first.direction_map.dot(present.direction_map)),
              1e-12);
}

TEST(Triangulate, PresentRayIsProjectedOnTheEpipolarPlane) {
  // Baseline along y, first ray along x: the epipolar plane is z = 0. The present ray is off it.
  const Ray first{{0, 0, 0}, {1, 0, 0}};
  const Ray present{{0, -1, 0}, Eigen::Vector3d(4, 1, 0.02).normalized()};
  const auto found = triangulate(first, present);
  ASSERT_TRUE(found);
  EXPECT_LT((found->position_map - Eigen::Vector3d(4, 0, 0)).norm(), 1e-12);
}

TEST(Triangulate, DivergingRaysHaveNoPoint) {
  // arccos (5.13) loses the sign here and gives a point in front, at the same depth as that of the
  // mirrored, converging pair.
  const Ray first{{0, 0, 0}, {1, 0, 0}};
  const Ray apart{{0, -1, 0}, Eigen::Vector3d(4, -1, 0).normalized()};
  const Ray together{{0, -1, 0}, Eigen::Vector3d(4, 1, 0).normalized()};
  EXPECT_FALSE(triangulate(first, apart));
  EXPECT_TRUE(triangulate(first, together));
}

TEST(Triangulate, ParallelRaysHaveNoPoint) {
  EXPECT_FALSE(triangulate({{0, 0, 0}, {1, 0, 0}}, {{0, 1, 0}, {1, 0, 0}}));
}

TEST(Triangulate, PointMustLieBeforeBothCameras) {
  // Lines that meet behind the first camera, the second, and both.
  const Eigen::Vector3d point(4, 1, 0);
  const Eigen::Vector3d a(0, 0, 0);
  const Eigen::Vector3d b(0, 2, 0);
  const auto backward = [&](const Eigen::Vector3d& from) {
    return Ray{from, -(point - from).normalized()};
  };
  EXPECT_TRUE(triangulate(rayTo(a, point), rayTo(b, point)));
  EXPECT_FALSE(triangulate(backward(a), rayTo(b, point)));
  EXPECT_FALSE(triangulate(rayTo(a, point), backward(b)));
  EXPECT_FALSE(triangulate(backward(a), backward(b)));
}

TEST(Triangulate, NoBaselineOrMotionAlongTheRayHasNoPoint) {
  const Eigen::Vector3d point(4, 1, 0);
  const Ray first = rayTo({0, 0, 0}, point);
  EXPECT_FALSE(triangulate(first, first));
  EXPECT_FALSE(triangulate(first, rayTo(0.5 * point, point)));
  EXPECT_FALSE(triangulate(first, rayTo(-point, point)));
}

TEST(Triangulate, NothingFiniteComesOfNotANumber) {
  const double nan = std::nan("");
  const Ray good{{0, 0, 0}, {1, 0, 0}};
  EXPECT_FALSE(triangulate(good, {{0, nan, 0}, {1, 0, 0}}));
  EXPECT_FALSE(triangulate(good, {{0, -1, 0}, {1, nan, 0}}));
  EXPECT_FALSE(triangulate({{0, 0, 0}, {nan, 0, 0}}, {{0, -1, 0}, {1, 0.1, 0}}));
}

TEST(EpipolarOffset, SignsOfDepthAndDistanceFromThePlane) {
  const Ray first{{0, 0, 0}, {1, 0, 0}};
  const auto at = [&](const Eigen::Vector3d& direction) {
    return epipolarOffset(first, {{0, -1, 0}, direction.normalized()});
  };
  const auto converging = at({4, 1, 0});
  ASSERT_TRUE(converging);
  EXPECT_NEAR(converging->across, 0, 1e-15);
  EXPECT_NEAR(converging->along, 1 / std::sqrt(17.0), 1e-12);
  EXPECT_GT(converging->ahead, 0);

  const auto off_plane = at({4, 1, -0.5});
  EXPECT_NEAR(off_plane->across, 0.5 / std::sqrt(17.25), 1e-12) << "never negative";

  EXPECT_LT(at({4, -1, 0})->along, 0) << "the rays diverge";

  // Motion backward along y: the lines meet at x = -4, behind the first camera.
  const auto behind = at({-4, 1, 0});
  EXPECT_GT(behind->along, 0);
  EXPECT_LT(behind->ahead, 0);
}

TEST(EpipolarOffset, NoPlaneWithoutBaseline) {
  const Ray ray{{1, 2, 3}, {1, 0, 0}};
  EXPECT_FALSE(epipolarOffset(ray, ray));
  EXPECT_FALSE(epipolarOffset(ray, {{2, 2, 3}, {1, 0, 0}})) << "motion along the first ray";
}

// At 2 degrees of parallax (5.19) says 0.024 m, which says nothing of the depth.
TEST(Sigma, OfTheDepthIsTheScatterOfNoisyRays) {
  const double parallax_rad = 2 * M_PI / 180;
  const double sigma_p_m = 0.01;
  const double sigma_a_rad = 0.001;
  const double baseline_m = 0.5;
  const Eigen::Vector3d point(baseline_m / std::tan(parallax_rad), 0, 0);
  RandomSource random(5);
  double squares = 0;
  constexpr int kRuns = 20000;
  for (int i = 0; i < kRuns; ++i) {
    const auto turned = [&](const Ray& ray) {
      return Ray{ray.origin_map,
                 Eigen::AngleAxisd(sigma_a_rad * random.normal(), Eigen::Vector3d::UnitZ()) *
                     ray.direction_map};
    };
    Ray present = rayTo({0, -baseline_m, 0}, point);
    present.origin_map += sigma_p_m * random.normal3();
    const auto found = triangulate(turned(rayTo({0, 0, 0}, point)), turned(present));
    ASSERT_TRUE(found);
    squares += (found->position_map - point).squaredNorm();
  }
  const double scatter_m = std::sqrt(squares / kRuns);
  const double sigma_m = measurementSigma_m(sigma_p_m, point.x(), sigma_a_rad);
  EXPECT_NEAR(sigma_m, 0.0243, 1e-4);
  EXPECT_GT(scatter_m, 10 * sigma_m);
  EXPECT_NEAR(depthSigma_m(sigma_m, parallax_rad) / scatter_m, 1.0, 0.2);
  EXPECT_TRUE(std::isfinite(depthSigma_m(sigma_m, 0)));
}

}  // namespace
}  // namespace ardrone_vslam
