// SPDX-License-Identifier: BSD-3-Clause
#include "map/landmark_locator.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>

#include "simulation/random_source.hpp"
#include "support/printed_filter.hpp"

namespace ardrone_vslam {
namespace {

using test::printedOnly;

constexpr double kPixel_rad = 1.0 / 570;

/// Landmarks 2 to 10 m ahead within a camera's field of 80 x 52 degrees, seen from the origin.
std::vector<Observation> observationsAhead(int count, double landmark_sigma_m,
                                           RandomSource& random) {
  std::vector<Observation> observations;
  for (int i = 0; i < count; ++i) {
    const double y = std::tan(random.uniform(-40, 40) * M_PI / 180);
    const double z = std::tan(random.uniform(-26, 26) * M_PI / 180);
    Observation s;
    s.direction_map = Eigen::Vector3d(1, y, z).normalized();
    s.landmark_map = random.uniform(2, 10) * s.direction_map;
    s.landmark_map += landmark_sigma_m * random.normal3();
    s.landmark_sigma_m = landmark_sigma_m;
    observations.push_back(s);
  }
  return observations;
}

TEST(LandmarkLocator, WorkedExampleOfThePrintedMean) {
  const LandmarkLocator locator(printedOnly());
  // Two landmarks, seen along x and along y; the prediction is 0.1 m off in each.
  std::vector<Observation> observations(2);
  observations[0] = {{5, 0.2, 0}, {1, 0, 0}, 0.05, 0};
  observations[1] = {{0.4, 3, 0}, {0, 1, 0}, 0.02, 0};
  const Eigen::Vector3d predicted(0.1, 0.1, 0);
  const auto fix = locator.locate(observations, predicted, 0.01);
  ASSERT_TRUE(fix);
  // (6.1, 6.2): d = 4.9 and 2.9; p = l - d s = (0.1, 0.2, 0) and (0.4, 0.1, 0).
  // (6.3): sigma = 0.05 + 0.049 and 0.02 + 0.029; (6.4): weights 1 / sigma.
  const double w0 = 1 / 0.099;
  const double w1 = 1 / 0.049;
  EXPECT_NEAR(fix->position_map.x(), (w0 * 0.1 + w1 * 0.4) / (w0 + w1), 1e-12);
  EXPECT_NEAR(fix->position_map.y(), (w0 * 0.2 + w1 * 0.1) / (w0 + w1), 1e-12);
  EXPECT_NEAR(fix->distance_m, (w0 * 4.9 + w1 * 2.9) / (w0 + w1), 1e-12);
  const double sigma = std::sqrt(2.0) / (w0 + w1);
  EXPECT_TRUE(fix->covariance.isApprox(sigma * sigma * Eigen::Matrix3d::Identity(), 1e-12));
}

// The odometry is 0.5 m off along the optical axis, 50 landmarks, 80 x 52 degrees.
TEST(LandmarkLocator, PrintedMeanIsDampedAlongTheRaysTheExactOneIsNot) {
  const Eigen::Vector3d predicted(0.5, 0, 0);
  ThesisFilterConfig config = printedOnly();
  double printed_error = 0;
  double exact_error = 0;
  double exact_claim = 0;
  constexpr int kRuns = 200;
  for (int run = 0; run < kRuns; ++run) {
    RandomSource random(static_cast<std::uint64_t>(run));
    const auto observations = observationsAhead(50, 0.02, random);
    config.mean = MeanKind::kPrinted;
    printed_error +=
        LandmarkLocator(config).locate(observations, predicted, kPixel_rad)->position_map.x();
    config.mean = MeanKind::kExact;
    const auto exact = LandmarkLocator(config).locate(observations, predicted, kPixel_rad);
    exact_error += std::abs(exact->position_map.x());
    exact_claim += std::sqrt(exact->covariance(0, 0));
  }
  EXPECT_NEAR(printed_error / kRuns, 0.417, 0.03) << "about four fifths of the error stay";
  EXPECT_LT(exact_error / kRuns, 0.02);
  EXPECT_GT(exact_claim / kRuns, exact_error / kRuns) << "0.8 deviations are the mean distance";
}

TEST(LandmarkLocator, CovarianceOfTheExactMeanIsItsScatter) {
  ThesisFilterConfig config = printedOnly();
  config.mean = MeanKind::kExact;
  config.outlier_sigmas = 0;  // weighed down, good ones claim a fifth more than their scatter
  const LandmarkLocator locator(config);
  RandomSource geometry(3);
  const auto truth = observationsAhead(30, 0, geometry);
  RandomSource random(4);
  constexpr int kRuns = 4000;
  constexpr double kSigma_m = 0.03;
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d claimed = Eigen::Matrix3d::Zero();
  for (int run = 0; run < kRuns; ++run) {
    auto observations = truth;
    for (Observation& s : observations) {
      s.landmark_map += kSigma_m * random.normal3();
      s.landmark_sigma_m = kSigma_m;
    }
    const auto fix = locator.locate(observations, Eigen::Vector3d::Zero(), 1e-9);
    ASSERT_TRUE(fix);
    scatter += fix->position_map * fix->position_map.transpose() / kRuns;
    claimed += fix->covariance / kRuns;
  }
  // In the claim's own units the scatter is the identity.
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> root(claimed);
  const Eigen::Matrix3d whitened =
      root.operatorInverseSqrt() * scatter * root.operatorInverseSqrt();
  EXPECT_LT((whitened - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), 0.1) << whitened;
}

TEST(LandmarkLocator, SigmaOfThePrintedMeanShrinksWithTheRootOfTheNumber) {
  const LandmarkLocator locator(printedOnly());
  const Observation s{{5, 0, 0}, {1, 0, 0}, 0.1, 0};
  const auto one = locator.locate({s}, Eigen::Vector3d::Zero(), 0);
  const auto four = locator.locate({s, s, s, s}, Eigen::Vector3d::Zero(), 0);
  EXPECT_NEAR(std::sqrt(one->covariance(0, 0)), 0.1, 1e-12);
  EXPECT_NEAR(std::sqrt(four->covariance(0, 0)), 0.05, 1e-12);
}

TEST(LandmarkLocator, FloorsHoldErrorsThatAllLandmarksShare) {
  ThesisFilterConfig config = printedOnly();
  config.fix_sigma_floor_m = 0.03;
  config.fix_angle_floor_deg = 1;
  const LandmarkLocator locator(config);
  const std::vector<Observation> many(10000, Observation{{4, 0, 0}, {1, 0, 0}, 0.1, 0});
  const auto fix = locator.locate(many, Eigen::Vector3d::Zero(), 0);
  EXPECT_NEAR(std::sqrt(fix->covariance(2, 2)), std::hypot(0.03, 4 * M_PI / 180, 0.001), 1e-9);
}

TEST(LandmarkLocator, TooFewLandmarksFixNothing) {
  ThesisFilterConfig config = printedOnly();
  config.min_landmarks = 3;
  const LandmarkLocator locator(config);
  RandomSource random(1);
  const auto three = observationsAhead(3, 0.1, random);
  const std::vector<Observation> two(three.begin(), three.begin() + 2);
  EXPECT_FALSE(locator.locate({}, Eigen::Vector3d::Zero(), kPixel_rad));
  EXPECT_FALSE(locator.locate(two, Eigen::Vector3d::Zero(), kPixel_rad));
  EXPECT_TRUE(locator.locate(three, Eigen::Vector3d::Zero(), kPixel_rad));
}

TEST(LandmarkLocator, ExactMeanWeighsWrongMatchesDown) {
  ThesisFilterConfig config = printedOnly();
  config.mean = MeanKind::kExact;
  ThesisFilterConfig trusting = config;
  trusting.outlier_sigmas = 0;
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    RandomSource random(seed);
    auto observations = observationsAhead(100, 0.02, random);
    for (std::size_t i = 0; i < 30; ++i)  // another thing to the left of what the landmarks show
      observations[i].direction_map =
          (observations[i].direction_map + Eigen::Vector3d(0, 0.1, 0)).normalized();
    const auto fix =
        LandmarkLocator(config).locate(observations, Eigen::Vector3d::Zero(), kPixel_rad);
    const auto drawn =
        LandmarkLocator(trusting).locate(observations, Eigen::Vector3d::Zero(), kPixel_rad);
    ASSERT_TRUE(fix && drawn);
    EXPECT_LT(fix->position_map.norm(), 0.03) << seed;
    EXPECT_GT(drawn->position_map.norm(), 3 * fix->position_map.norm()) << seed;
  }
}

TEST(LandmarkLocator, ExactMeanRefusesLandmarksInOneDirection) {
  ThesisFilterConfig config = printedOnly();
  config.mean = MeanKind::kExact;
  const LandmarkLocator locator(config);
  const std::vector<Observation> same(5, Observation{{5, 0, 0}, {1, 0, 0}, 0.1, 0});
  EXPECT_FALSE(locator.locate(same, Eigen::Vector3d::Zero(), kPixel_rad));
}

TEST(LandmarkLocator, DegenerateObservationsGiveNoNumberThatIsNotFinite) {
  const LandmarkLocator locator(printedOnly());
  const std::vector<Observation> at_camera(3, Observation{{0, 0, 0}, {1, 0, 0}, 0, 0});
  EXPECT_FALSE(locator.locate(at_camera, Eigen::Vector3d::Zero(), 0));
}

TEST(LandmarkLocator, RefusesInvalidParameters) {
  LocatorConfig config;
  config.min_landmarks = 0;
  EXPECT_THROW(LandmarkLocator{config}, ConfigError);
}

}  // namespace
}  // namespace ardrone_vslam
