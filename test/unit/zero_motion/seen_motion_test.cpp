// SPDX-License-Identifier: BSD-3-Clause
#include "zero_motion/seen_motion.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "ardrone_vslam/rotation.hpp"
#include "simulation/random_source.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kCorner_rad = 0.001;
constexpr double kRotationSigma_rad = 0.002;
constexpr int kTracks = 80;

/// A camera that looks at points about 1 away, all lengths being over the typical depth.
struct Scene {
  std::vector<BearingPair> pairs;
  Eigen::Vector3d displacement = Eigen::Vector3d::Zero();
  Eigen::Matrix3d R_then_now = Eigen::Matrix3d::Identity();  // as it is known

  Scene(std::uint64_t seed, double displacement_length, double wrong_share = 0) {
    RandomSource random(seed, 1);
    displacement = displacement_length * random.normal3().normalized();
    const Eigen::Matrix3d R_true = rotationOf(0.05 * random.normal3());
    R_then_now = rotationOf(kRotationSigma_rad * random.normal3()) * R_true;
    for (int i = 0; i < kTracks; ++i) {
      const Eigen::Vector3d direction(random.uniform(-0.6, 0.6), random.uniform(-0.4, 0.4), 1);
      const Eigen::Vector3d point = random.uniform(0.75, 1.25) * direction.normalized();
      Eigen::Vector3d now = R_true.transpose() * (point - displacement);
      if (i < wrong_share * kTracks) now = R_true.transpose() * (point + random.normal3());
      pairs.push_back({(point.normalized() + kCorner_rad * random.normal3()).normalized(),
                       (now.normalized() + kCorner_rad * random.normal3()).normalized()});
    }
  }
};

/// Squared Mahalanobis length of its error, in the mean over many scenes; 3 is honest.
double meanSquares(double displacement_length, double wrong_share = 0) {
  constexpr int kScenes = 200;
  double sum = 0;
  for (int i = 0; i < kScenes; ++i) {
    const Scene scene(static_cast<std::uint64_t>(i), displacement_length, wrong_share);
    const auto seen = seenMotion(scene.pairs, scene.R_then_now, kRotationSigma_rad, kCorner_rad);
    if (!seen) {
      ADD_FAILURE() << "scene " << i;
      continue;
    }
    const Eigen::Vector3d off = seen->displacement - scene.displacement;
    sum += off.dot(seen->covariance.inverse() * off) / kScenes;
  }
  return sum;
}

// Neighbours err alike in images, not here: 80 tracks tell more than the 20 that they count as.
TEST(SeenMotion, CoversItsError) {
  for (const double displacement : {0.0, 0.003, 0.01, 0.03}) {
    EXPECT_GT(meanSquares(displacement), 0.15) << displacement;
    EXPECT_LT(meanSquares(displacement), 3.5) << displacement;
  }
}

TEST(SeenMotion, AThirdOfTheTracksMayBeWrong) {
  for (const double displacement : {0.003, 0.03})
    EXPECT_LT(meanSquares(displacement, 0.33), 3.5) << displacement;
}

TEST(SeenMotion, ATurnThatIsHardlyKnownHidesAWayAcrossTheView) {
  const Scene scene(1, 0.01);
  const auto surely = seenMotion(scene.pairs, scene.R_then_now, 1e-5, kCorner_rad);
  const auto hardly = seenMotion(scene.pairs, scene.R_then_now, 0.1, kCorner_rad);
  ASSERT_TRUE(surely && hardly);
  for (int axis = 0; axis < 2; ++axis) {
    EXPECT_LT(surely->covariance(axis, axis), surely->covariance(2, 2));
    EXPECT_GT(hardly->covariance(axis, axis), 2 * surely->covariance(axis, axis));
  }
}

TEST(SeenMotion, TracksThatAgreeOnNothingTellNone) {
  const Scene scene(1, 0.01, 0.9);
  EXPECT_FALSE(seenMotion(scene.pairs, scene.R_then_now, kRotationSigma_rad, kCorner_rad));
  EXPECT_FALSE(seenMotion({}, scene.R_then_now, kRotationSigma_rad, kCorner_rad));
}

}  // namespace
}  // namespace ardrone_vslam
