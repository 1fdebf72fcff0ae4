// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "ardrone_vslam/tracker.hpp"
#include "support/generated_image.hpp"
#include "support/intrinsics.hpp"

namespace ardrone_vslam {
namespace {

std::vector<Descriptor> describe(bool use_attitude, std::optional<float> rotation_rad) {
  static const test::TestImage image = test::generatedImage(320, 240);
  TrackerConfig config;
  config.use_attitude = use_attitude;
  config.corners.threshold = 8;
  Tracker tracker(config, test::pinhole(320, 240, 300));
  ImageFeatures features;
  tracker.process(image.view(), 1, features, {}, rotation_rad);
  return features.descriptor;
}

TEST(TrackerAttitude, TheTurnCountsOnlyWithUseAttitude) {
  const auto own = describe(false, std::nullopt);
  ASSERT_GT(own.size(), 20U);
  EXPECT_EQ(describe(false, 0.5F), own);
  EXPECT_EQ(describe(true, std::nullopt), own) << "not known: each corner's own orientation";
  const auto upright = describe(true, 0.F);
  const auto turned = describe(true, 0.5F);
  ASSERT_EQ(upright.size(), own.size());
  EXPECT_NE(upright, own);
  EXPECT_NE(turned, upright);
}

}  // namespace
}  // namespace ardrone_vslam
