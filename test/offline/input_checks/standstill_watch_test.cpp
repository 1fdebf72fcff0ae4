// SPDX-License-Identifier: BSD-3-Clause
#include "input_checks/standstill_watch.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ardrone_vslam {
namespace {

constexpr std::int64_t kPeriod_ns = 50'000'000;
constexpr int kPatience = 1 + static_cast<int>(StandstillWatch::kPatience_ns / kPeriod_ns);
constexpr float kFocal_px = 300;

/// What a camera sees that looks along its own z axis at points around the origin of the map.
ImageFeatures lookFrom(const Eigen::Isometry3d& T_map_cam, std::int64_t stamp_ns, int points) {
  ImageFeatures features;
  features.stamp_ns = stamp_ns;
  features.focal_length_px = kFocal_px;
  for (int i = 0; i < points; ++i) {
    const Eigen::Vector3d point_map(0.1 * (i % 7), 0.1 * (i % 5), 3 + 0.1 * (i % 11));
    const Eigen::Vector3d bearing = (T_map_cam.inverse() * point_map).normalized();
    features.pixel_px.emplace_back(0.F, 0.F);
    features.bearing_cam.push_back(bearing.cast<float>());
    features.track_id.push_back(static_cast<std::uint32_t>(100 - i));
  }
  return features;
}

class StandstillWatchTest : public testing::Test {
 protected:
  /// Images at rest or in motion, with odometry that tells the share `told` of position and turn.
  void fly(int images, const Eigen::Vector3d& step_m, double rotation_rad, double told_m,
           double told_rad, int points = 40) {
    for (int i = 0; i < images; ++i) {
      stamp_ns_ += kPeriod_ns;
      position_m_ += step_m;
      yaw_rad_ += rotation_rad;
      odom_m_ += told_m * step_m;
      odom_rad_ += told_rad * rotation_rad;
      watch_.see(lookFrom(pose(position_m_, yaw_rad_), stamp_ns_, points),
                 pose(odom_m_, odom_rad_));
    }
  }
  static Eigen::Isometry3d pose(const Eigen::Vector3d& position_m, double yaw_rad) {
    return Eigen::Translation3d(position_m) * Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitY());
  }

  const Eigen::Vector3d kSideways_m{0.03, 0, 0};  // 3 px
  StandstillWatch watch_;
  std::int64_t stamp_ns_ = 1;
  Eigen::Vector3d position_m_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d odom_m_ = Eigen::Vector3d::Zero();
  double yaw_rad_ = 0;
  double odom_rad_ = 0;
};

TEST_F(StandstillWatchTest, NamesOdometryThatNeverMoves) {
  fly(kPatience / 2, kSideways_m, 0, 0, 0);
  EXPECT_FALSE(watch_.isStuck()) << "not at once";
  fly(kPatience, kSideways_m, 0, 0, 0);
  EXPECT_TRUE(watch_.isStuck());
  fly(kPatience, Eigen::Vector3d::Zero(), 0, 0, 0);
  EXPECT_TRUE(watch_.isStuck()) << "the camera at rest proves nothing";
  fly(1, kSideways_m, 0, 1, 1);
  EXPECT_FALSE(watch_.isStuck()) << "the odometry has come to life";
}

TEST_F(StandstillWatchTest, SlowMotionCountsToo) {
  fly(3 * kPatience, kSideways_m / 6, 0, 0, 0);
  EXPECT_TRUE(watch_.isStuck());
}

TEST_F(StandstillWatchTest, TurningThatTheOdometryDoesNotTellIsMotion) {
  fly(2 * kPatience, Eigen::Vector3d::Zero(), 0.02, 0, 0);
  EXPECT_TRUE(watch_.isStuck());
}

TEST_F(StandstillWatchTest, TranslationIsSeenBesideTurning) {
  fly(2 * kPatience, kSideways_m, 0.005, 0, 1);
  EXPECT_TRUE(watch_.isStuck());
}

TEST_F(StandstillWatchTest, ACameraAtRestIsNoFault) {
  fly(5 * kPatience, Eigen::Vector3d::Zero(), 0, 0, 0);
  EXPECT_FALSE(watch_.isStuck());
}

TEST_F(StandstillWatchTest, TurningOnTheSpotIsNoFault) {
  fly(5 * kPatience, Eigen::Vector3d::Zero(), 0.02, 0, 0.9);
  EXPECT_FALSE(watch_.isStuck()) << "though the odometry misses a tenth of it";
}

TEST_F(StandstillWatchTest, OdometryThatMovesIsNoFault) {
  fly(5 * kPatience, kSideways_m, 0, 1e-3, 0);
  EXPECT_FALSE(watch_.isStuck());
}

TEST_F(StandstillWatchTest, SomethingThatPassesByIsNoFault) {
  for (int i = 0; i < 5; ++i) {
    fly(kPatience / 2, kSideways_m, 0, 0, 0);
    fly(kPatience / 2, Eigen::Vector3d::Zero(), 0, 0, 0);
  }
  EXPECT_FALSE(watch_.isStuck());
}

TEST_F(StandstillWatchTest, FewTracksSayNothing) {
  fly(5 * kPatience, kSideways_m, 0, 0, 0, static_cast<int>(StandstillWatch::kTracks) - 1);
  fly(5 * kPatience, kSideways_m, 0, 0, 0, 0);
  EXPECT_FALSE(watch_.isStuck());
}

TEST(ExplainStandstill, NamesTopicAndRemedy) {
  const std::string sentence = explainStandstill("/odom");
  for (const auto* part : {"/odom does not move", "rostopic echo /odom", "remap"}) {
    EXPECT_NE(sentence.find(part), std::string::npos) << part;
  }
}

}  // namespace
}  // namespace ardrone_vslam
