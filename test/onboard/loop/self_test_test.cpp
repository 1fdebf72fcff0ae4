// SPDX-License-Identifier: BSD-3-Clause
#include "loop/self_test.hpp"

#include <gtest/gtest.h>

#include "loop/cpu_share.hpp"

namespace ardrone_vslam::test {
namespace {

TEST(SelfTest, TheKernelsGiveTheEmbeddedValue) {
  EXPECT_EQ(kernelHash(), kGoldenHash);
}

TEST(SelfTest, SaysWhetherTheCameraIsThere) {
  Settings settings;
  settings.onboard.frames = "-";
  EXPECT_TRUE(selfTest(settings));
  settings.onboard.frames = "/dev/ardrone_vslam_none";
  EXPECT_FALSE(selfTest(settings));
}

TEST(CpuShareTest, TheNextWorkWaitsForItsShare) {
  CpuShare share(0.25);
  EXPECT_LE(share.next_ns(), 0);
  share.begin(1000, 50);
  EXPECT_EQ(share.end(70), 20);
  EXPECT_EQ(share.next_ns(), 1080);
}

}  // namespace
}  // namespace ardrone_vslam::test
