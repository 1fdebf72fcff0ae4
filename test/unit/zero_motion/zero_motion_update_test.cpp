// SPDX-License-Identifier: BSD-3-Clause
#include "zero_motion/zero_motion_update.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/odometry_window.hpp"
#include "support/turning_camera.hpp"

namespace ardrone_vslam {
namespace {

/// Five seconds sideways, 4 m before the scene.
struct Flight {
  Flight() {
    test::PointCamera camera(1);
    for (int i = 0; i < 100; ++i) {
      OdometryState odometry;
      odometry.stamp_ns = test::swayStamp_ns(0.05 * i);
      odometry.T_odom_base.translation().y() = 0.05 * i;
      const bool is_kept = i == 0 || update.isReference(window.newest().id);
      window.add(odometry);
      if (!is_kept) window.removeFrame(window.frames().size() - 2);
      ImageFeatures features = camera.look(odometry.T_odom_base, odometry.stamp_ns);
      features.descriptor.resize(features.bearing_cam.size());
      update.apply(features, test::forwardExtrinsics(), odometry.T_odom_base, false, window);
    }
  }

  OdometryWindow window;
  ZeroMotionUpdate update;
};

TEST(ZeroMotionUpdate, LearnsTheDepthOfTheScene) {
  const Flight flight;
  EXPECT_LT(flight.update.sceneDepth().quantile_m(0.99), 10);
  EXPECT_GT(SceneDepth().quantile_m(0.99), 60);
}

TEST(ZeroMotionUpdate, ForgetsItWithTheCameraAndWhenItBeginsAnew) {
  for (const bool is_camera : {true, false}) {
    Flight flight;
    is_camera ? flight.update.beginAnew(flight.window) : flight.update.reset();
    for (const double probability : {0.1, 0.5, 0.99})
      EXPECT_EQ(flight.update.sceneDepth().quantile_m(probability),
                SceneDepth().quantile_m(probability));
  }
}

}  // namespace
}  // namespace ardrone_vslam
