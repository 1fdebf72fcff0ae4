// SPDX-License-Identifier: BSD-3-Clause
#include "msckf/anchors.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "support/odometry_window.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kPointDistance_m = 1;

MsckfConfig atMostTwo() {
  MsckfConfig config;
  config.max_anchors = 2;
  return config;
}

class AnchorsTest : public ::testing::Test {
 protected:
  /// A frame so far along x, which landmarks belong to if it is chosen.
  std::uint32_t add(double x_m) {
    OdometryState odometry;
    odometry.stamp_ns = 1'000'000'000LL * ++frames_;
    odometry.T_odom_base.translation().x() = x_m;
    window_.add(odometry);
    anchors_.choose(window_, kPointDistance_m);
    anchors_.use();
    return anchors_.current();
  }
  std::vector<std::uint32_t> anchorsLeft() {
    while (window_.frames().size() > 1) anchors_.retire(0, window_);
    std::vector<std::uint32_t> ids;
    for (const Clone& anchor : window_.anchors()) ids.push_back(anchor.id);
    return ids;
  }

  int frames_ = 0;
  OdometryWindow window_;
  Anchors anchors_{atMostTwo()};
};

TEST_F(AnchorsTest, TheNearestTwoAreJoined) {
  const std::uint32_t first = add(0);
  add(0.4);
  const std::uint32_t last = add(2);
  add(9);
  EXPECT_EQ(anchorsLeft(), (std::vector<std::uint32_t>{first, last}));
}

TEST_F(AnchorsTest, WhatTheCameraDidNotSeeTheWayToGetsAnAnchorOfItsOwn) {
  const std::uint32_t before = add(0);
  EXPECT_EQ(add(0.1), before);
  anchors_.breakOff();
  const std::uint32_t after = add(0.1);
  EXPECT_NE(after, before);
  add(2);
  add(9);
  EXPECT_EQ(anchorsLeft(), (std::vector<std::uint32_t>{before, after}))
      << "the way between the two is not known: they only seem near each other";
}

}  // namespace
}  // namespace ardrone_vslam
