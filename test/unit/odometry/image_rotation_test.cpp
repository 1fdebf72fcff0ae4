// SPDX-License-Identifier: BSD-3-Clause
#include "odometry/image_rotation.hpp"

#include <gtest/gtest.h>

#include "ardrone_vslam/rotation.hpp"
#include "simulation/random_source.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kCorner_rad = 0.001;
constexpr int kTracks = 100;

/// Two images of the same points, and how the camera moved in between.
struct Scene {
  std::vector<BearingPair> pairs;
  KnownMotion known;

  /// @param is_floor  the points lie in a plane across the view
  Scene(std::uint64_t seed, bool is_floor) {
    RandomSource random(seed, 1);
    const Eigen::Vector3d displacement_m(0.15, 0.12, 0.05);
    known.R_then_now = rotationOf(Eigen::Vector3d(0.01, -0.02, 0.03));
    known.rotation_sigma_rad = 0.005;
    known.displacement = {displacement_m, 0.1 * displacement_m.norm()};
    for (int i = 0; i < kTracks; ++i) {
      Eigen::Vector3d point(random.uniform(-0.5, 0.5), random.uniform(-0.4, 0.4), 1);
      point *= is_floor ? 2 : random.uniform(1, 4);
      const Eigen::Vector3d now = known.R_then_now.transpose() * (point - displacement_m);
      pairs.push_back({(point.normalized() + kCorner_rad * random.normal3()).normalized(),
                       (now.normalized() + kCorner_rad * random.normal3()).normalized()});
    }
  }

  double squares(const Eigen::Vector3d& rotation_rad) const {
    const auto fitted = fitMotion(pairs, kCorner_rad, known.displacement);
    if (!fitted) {
      ADD_FAILURE();
      return 0;
    }
    KnownMotion told = known;
    told.R_then_now = rotationOf(rotation_rad) * told.R_then_now;
    return squaresAgainst(told, *fitted, pairs, kCorner_rad);
  }
};

// Measured: at most 1.6, and at least 585 for the next.
TEST(ImageRotation, NothingSpeaksAgainstTheTrueMotion) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    for (const bool is_floor : {false, true})
      EXPECT_LT(Scene(seed, is_floor).squares(Eigen::Vector3d::Zero()), 2.4) << seed;
}

TEST(ImageRotation, ATurnAboutTheViewThatIsNotThereIsSeen) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    for (const bool is_floor : {false, true})
      EXPECT_GT(Scene(seed, is_floor).squares({0, 0, 0.3}), 400) << seed;
}

}  // namespace
}  // namespace ardrone_vslam
