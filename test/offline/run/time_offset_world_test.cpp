// SPDX-License-Identifier: BSD-3-Clause
// The images' time offset, found in rendered flights whose images are stamped early or late.
#include <gtest/gtest.h>

#include <cmath>

#include "ardrone_vslam/time_offset.hpp"
#include "run/front_end.hpp"
#include "simulation/odometry_model.hpp"
#include "support/shipped_profiles.hpp"
#include "world/world_sequence.hpp"

namespace ardrone_vslam {
namespace {

std::vector<ImageFeatures> featuresOf(WorldSequence& sequence) {
  std::vector<ImageFeatures> features;
  runFrontEnd(sequence, TrackerConfig{}, {}, 2,
              [&](const TrackedFrame& frame) { features.push_back(frame.features); });
  return features;
}

/// Once each image is stamped `offset_s` early.
TimeOffset find(const WorldSequence& sequence, std::vector<ImageFeatures> images,
                const std::string& profile, std::uint64_t seed, double offset_s) {
  const OdometryRun run = simulateOdometry(sequence.truth(), test::shippedProfile(profile), seed);
  OdometryBufferConfig config;
  config.buffer_s = 60;
  OdometryBuffer odometry(config);
  for (const OdometryState& state : run.states) odometry.push(state);
  TimeOffsetEstimator estimator(sequence.T_base_cam());
  for (ImageFeatures& image : images) {
    image.stamp_ns -= std::llround(offset_s * 1e9);
    estimator.see(image, odometry);
    const TimeOffset& found = estimator.estimate();
    if (found.state == TimeOffsetState::kKnown) {
      EXPECT_LT(std::abs(found.offset_s - offset_s), 5 * found.sigma_s);
    }
  }
  return estimator.estimate();
}

void expectFoundInTwentySeconds(double rate_hz) {
  WorldOptions options;
  options.duration_s = 20;
  options.rate_hz = rate_hz;
  WorldSequence sequence(options);
  const std::vector<ImageFeatures> images = featuresOf(sequence);
  for (const double offset_s : {0.0, 0.04, 0.1, -0.1}) {
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      const TimeOffset found = find(sequence, images, "drone", seed, offset_s);
      ASSERT_EQ(found.state, TimeOffsetState::kKnown) << offset_s << " s, seed " << seed;
      EXPECT_NEAR(found.offset_s, offset_s, 0.01) << "seed " << seed;
    }
  }
}

TEST(TimeOffsetWorld, IsFoundInTwentySecondsOfLapsAt30Hz) {
  expectFoundInTwentySeconds(30);
}

TEST(TimeOffsetWorld, IsFoundInTwentySecondsOfLapsAt20Hz) {
  expectFoundInTwentySeconds(20);
}

TEST(TimeOffsetWorld, TurningEvenlyOnTheSpotIsNotEnoughForANoisyAttitude) {
  WorldOptions options;
  options.flight = "pure_yaw";
  options.duration_s = 20;
  options.rate_hz = 20;
  WorldSequence sequence(options);
  const std::vector<ImageFeatures> images = featuresOf(sequence);
  EXPECT_EQ(find(sequence, images, "drone", 1, 0.04).state, TimeOffsetState::kTooLittleRotation);
}

}  // namespace
}  // namespace ardrone_vslam
