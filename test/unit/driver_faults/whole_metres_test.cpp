// SPDX-License-Identifier: BSD-3-Clause
#include "driver_faults/whole_metres.hpp"

#include <gtest/gtest.h>

namespace ardrone_vslam {
namespace {

TEST(WholeMetresWatch, AConstantHeightIsNone) {
  WholeMetresWatch watch;
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(watch.see(0, 0.01));
  EXPECT_FALSE(watch.see(0.01, 0.01)) << "takes off";
  EXPECT_FALSE(watch.see(1, 0.01));
  EXPECT_FALSE(watch.isWhole());
}

TEST(WholeMetresWatch, AClimbThatAWholeHeightDoesNotShowIsEnough) {
  WholeMetresWatch watch;
  int messages = 0;
  while (!watch.isWhole() && messages < 1000) {
    EXPECT_FALSE(watch.see(1, 0.001)) << "no step";
    ++messages;
  }
  EXPECT_GT(messages, 45);
  EXPECT_LT(messages, 60);
}

}  // namespace
}  // namespace ardrone_vslam
