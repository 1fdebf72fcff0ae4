// SPDX-License-Identifier: BSD-3-Clause
// Triangulation and thesis filter on random scenes and runs.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "map/triangulation.hpp"
#include "simulation/random_source.hpp"
#include "support/eigenvalues.hpp"
#include "support/seeds.hpp"
#include "thesis/thesis_filter.hpp"

namespace ardrone_vslam {
namespace {

Eigen::Vector3d direction(RandomSource& random) {
  return random.normal3().normalized();
}

TEST(TriangulationProperty, ExactRaysGiveTheirPointBackAtEveryScale) {
  for (const std::uint64_t seed : test::seeds()) {
    RandomSource random(seed);
    for (int i = 0; i < 5000; ++i) {
      const double scale_m = std::pow(10, random.uniform(-2, 3));
      const Eigen::Vector3d a = scale_m * random.normal3();
      const Eigen::Vector3d b = scale_m * random.normal3();
      const Eigen::Vector3d point = scale_m * random.normal3();
      const Ray first{a, (point - a).normalized()};
      const Ray present{b, (point - b).normalized()};
      const double sine = first.direction_map.cross(present.direction_map).norm();
      if (sine < 1e-3) continue;
      const auto found = triangulate(first, present);
      ASSERT_TRUE(found) << seed << ' ' << i;
      ASSERT_LT((found->position_map - point).norm(), 1e-9 * scale_m / (sine * sine));
      ASSERT_GT(found->depth_m, 0);
    }
  }
}

TEST(TriangulationProperty, WhateverIsFoundLiesBeforeBothCamerasOnThePresentPlane) {
  int found_count = 0;
  for (const std::uint64_t seed : test::seeds()) {
    RandomSource random(seed);
    for (int i = 0; i < 5000; ++i) {
      const Ray first{random.normal3(), direction(random)};
      const Ray present{random.normal3(), direction(random)};
      const auto found = triangulate(first, present);
      if (!found) continue;
      ++found_count;
      ASSERT_TRUE(found->position_map.allFinite());
      const Eigen::Vector3d from_first = found->position_map - first.origin_map;
      ASSERT_GT(from_first.dot(first.direction_map), 0);
      ASSERT_LT(from_first.cross(first.direction_map).norm(), 1e-6 * (1 + from_first.norm()))
          << "on the first ray";
      ASSERT_GT(found->parallax_rad, 0);
    }
  }
  EXPECT_GT(found_count, 1000);
}

TEST(TriangulationProperty, OffsetsAgreeWithTheTriangle) {
  RandomSource random(9);
  for (int i = 0; i < 5000; ++i) {
    const Ray first{random.normal3(), direction(random)};
    const Ray present{random.normal3(), direction(random)};
    const auto offset = epipolarOffset(first, present);
    ASSERT_TRUE(offset);
    ASSERT_GE(offset->across, 0);
    const bool in_front = offset->along > 0 && offset->ahead > 0;
    ASSERT_EQ(in_front, triangulate(first, present).has_value()) << i;
  }
}

class FilterProperty : public ::testing::TestWithParam<MeanKind> {};

std::vector<Observation> randomObservations(const Eigen::Vector3d& camera, double shared_m2,
                                            RandomSource& random) {
  std::vector<Observation> observations;
  const Eigen::Vector3d ahead = direction(random);
  for (int i = random.integer(0, 20); i > 0; --i) {
    Observation s;
    s.direction_map = (ahead + 0.5 * random.normal3()).normalized();
    s.landmark_map = camera + random.uniform(0.1, 50) * s.direction_map + 0.02 * random.normal3();
    s.landmark_sigma_m = random.uniform(0.001, 0.1);
    s.position_variance_m2 = shared_m2 * random.uniform(0.2, 1.2);
    observations.push_back(s);
  }
  return observations;
}

TEST_P(FilterProperty, CovarianceStaysSymmetricAndPositiveDefinite) {
  for (const std::uint64_t seed : test::seeds()) {
    RandomSource random(seed);
    ThesisFilterConfig config;
    config.mean = GetParam();
    config.min_landmarks = 2;
    config.common_drift = random.chance(0.7);
    config.fix_sigma_floor_m = random.chance(0.5) ? 0 : 0.01;
    config.fix_angle_floor_deg = 0;
    ThesisFilter filter(config);
    const LandmarkLocator locator(config);
    OdometryState state;
    filter.start(Eigen::Vector3d::Zero(), state);
    int fused = 0;
    for (int i = 0; i < 2000; ++i) {
      state.stamp_ns += random.integer(0, 200'000'000);
      state.T_odom_base.translation() += 0.1 * random.normal3();
      filter.predict(state);
      const double before_m2 = filter.covariance().trace() / 3;
      const auto observations = randomObservations(filter.position_map(), before_m2, random);
      const auto fix = locator.locate(observations, filter.position_map(), 0.002);
      if (fix && filter.fuse(*fix)) ++fused;
      const Eigen::Matrix3d& p = filter.covariance();
      ASSERT_TRUE(filter.position_map().allFinite()) << seed << ' ' << i;
      ASSERT_EQ(p, Eigen::Matrix3d(p.transpose())) << seed << ' ' << i;
      ASSERT_GT(test::leastEigenvalue(p), 0) << seed << ' ' << i;
      ASSERT_LE(p.trace() / 3, before_m2 * (1 + 1e-9)) << "a fix never makes it worse";
    }
    EXPECT_GT(fused, 200) << seed;
  }
}

TEST_P(FilterProperty, CovarianceNeverFallsBelowWhatTheLandmarksShare) {
  RandomSource random(12);
  ThesisFilterConfig config;
  config.mean = GetParam();
  config.min_landmarks = 1;
  ThesisFilter filter(config);
  OdometryState state;
  filter.start(Eigen::Vector3d::Zero(), state);
  int fused = 0;
  for (int i = 0; i < 2000; ++i) {
    state.stamp_ns += 100'000'000;
    filter.predict(state);
    PositionFix fix;
    fix.position_map = filter.position_map() + 0.01 * random.normal3();
    fix.covariance = random.uniform(1e-6, 1e-2) * Eigen::Matrix3d::Identity();
    fix.shared_variance_m2 = random.uniform(0, 1.5) * filter.covariance().trace() / 3;
    const double floor_m2 =
        std::min(test::leastEigenvalue(filter.covariance()), fix.shared_variance_m2);
    if (filter.fuse(fix)) ++fused;
    ASSERT_GE(test::leastEigenvalue(filter.covariance()), floor_m2 * (1 - 1e-9)) << i;
  }
  EXPECT_GT(fused, 1000);
}

INSTANTIATE_TEST_SUITE_P(Means, FilterProperty,
                         ::testing::Values(MeanKind::kPrinted, MeanKind::kExact),
                         [](const auto& mean) { return std::string(nameOf(mean.param)); });

}  // namespace
}  // namespace ardrone_vslam
