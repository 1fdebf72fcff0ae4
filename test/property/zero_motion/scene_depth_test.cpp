// SPDX-License-Identifier: BSD-3-Clause
#include "zero_motion/scene_depth.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/median.hpp"
#include "support/turning_camera.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kRate_hz = 20;
constexpr int kSeeds = 8;
/// Of PointCamera's points.
constexpr double kPoints_m = 4;

/// A drone before a scene, whose odometry has a constant velocity bias.
struct Case {
  double depth_m = kPoints_m;
  double speed_m_s = 0;    // to and fro, 8 s each way
  double sway_m = 0;       // about that path, as a drone that hovers
  double bias_m_s = 0.03;  // per axis
  double seconds = 20;
};

Eigen::Vector3d pathOf(const Case& c, double t_s) {
  const double there_s = std::abs(std::remainder(t_s, 16));
  return {c.sway_m * std::sin(0.7 * t_s), c.speed_m_s * there_s + c.sway_m * std::sin(1.1 * t_s),
          c.sway_m * std::sin(0.9 * t_s)};
}

SceneDepth filmed(const Case& c, std::uint64_t seed) {
  test::PointCamera camera(seed);
  RandomSource random(seed, 9);
  const Eigen::Vector3d bias_m_s = c.bias_m_s * random.normal3();
  SceneDepth depth;
  for (double t_s = 0; t_s < c.seconds; t_s += 1 / kRate_hz) {
    Eigen::Isometry3d T_map_base = Eigen::Isometry3d::Identity();
    // A scene so many times as large looks as this one from a path so many times as short.
    T_map_base.translation() = pathOf(c, t_s) * kPoints_m / c.depth_m;
    Eigen::Isometry3d T_odom_cam = test::forwardExtrinsics();
    T_odom_cam.translation() = pathOf(c, t_s) + t_s * bias_m_s;
    depth.see(camera.look(T_map_base, test::swayStamp_ns(t_s)), T_odom_cam);
  }
  return depth;
}

/// Of the seeds: quantile of the depth, in the median.
double medianOf(const Case& c, double probability) {
  std::vector<double> depths_m;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed)
    depths_m.push_back(filmed(c, seed).quantile_m(probability));
  return test::median(depths_m);
}

TEST(SceneDepth, BeforeAnythingIsSeenItIsARoomOrTenTimesThat) {
  const SceneDepth depth;
  EXPECT_NEAR(std::log(depth.quantile_m(0.5) / 5), 0, std::log(1.32));
  EXPECT_LT(depth.quantile_m(0.1), 1.3);
  EXPECT_GT(depth.quantile_m(0.9), 20);
  EXPECT_GT(depth.quantile_m(0.99), 60);
}

TEST(SceneDepth, AFlightTellsIt) {
  for (const double depth_m : {2.0, 10.0, 40.0}) {
    Case c;
    c.depth_m = depth_m;
    c.speed_m_s = 1;
    EXPECT_NEAR(std::log(medianOf(c, 0.5) / depth_m), 0, std::log(1.6)) << depth_m;
  }
}

// Both see as little: what tells them apart is that a bias stays as it is.
TEST(SceneDepth, ASlowFlightInAHallIsToldFromHoveringInARoom) {
  Case hovering;
  hovering.sway_m = 0.03;
  hovering.bias_m_s = 0.13;
  Case flying;
  flying.depth_m = 60;
  flying.speed_m_s = 0.3;
  flying.sway_m = 0.03;
  EXPECT_LT(medianOf(hovering, 0.9), 20);
  EXPECT_GT(medianOf(flying, 0.5), 20);
}

TEST(SceneDepth, CoversTheTrueDepth) {
  int inside = 0, all = 0;
  for (const double depth_m : {2.0, 6.0, 20.0, 60.0}) {
    for (const double speed_m_s : {0.1, 0.5, 2.0}) {
      Case c;
      c.depth_m = depth_m;
      c.speed_m_s = speed_m_s;
      c.sway_m = 0.03;
      for (std::uint64_t seed = 1; seed <= kSeeds; ++seed, ++all) {
        const SceneDepth depth = filmed(c, seed);
        inside += depth.quantile_m(0.01) < depth_m && depth_m < depth.quantile_m(0.99) ? 1 : 0;
      }
    }
  }
  // 98 of 100 are expected; measured: 94 of 96.
  EXPECT_GE(inside, all - 5) << "of " << all;
}

TEST(SceneDepth, NothingToCompareChangesNothing) {
  SceneDepth depth;
  const double before_m = depth.quantile_m(0.5);
  test::PointCamera camera(1);
  Eigen::Isometry3d T_odom_cam = test::forwardExtrinsics();
  ImageFeatures dark = camera.look(Eigen::Isometry3d::Identity(), test::swayStamp_ns(0));
  dark.bearing_cam.clear();
  dark.pixel_px.clear();
  dark.track_id.clear();
  for (int i = 0; i < 100; ++i) {
    dark.stamp_ns = test::swayStamp_ns(i / kRate_hz);
    T_odom_cam.translation().x() = 0.1 * i;
    depth.see(dark, T_odom_cam);
  }
  EXPECT_EQ(depth.quantile_m(0.5), before_m);
}

}  // namespace
}  // namespace ardrone_vslam
