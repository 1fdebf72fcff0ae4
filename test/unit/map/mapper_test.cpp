// SPDX-License-Identifier: BSD-3-Clause
#include "map/mapper.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/view_builder.hpp"

namespace ardrone_vslam {
namespace {

using test::ViewBuilder;

constexpr double kFocalLength_px = test::kPointFocalLength_px;

/// The camera looks along map's x; its first position is the origin.
class MapperTest : public ::testing::Test {
 protected:
  /// Stores what the first view shows.
  void seeFirst(const std::vector<Eigen::Vector3d>& points) {
    builder_.lookFrom({0, 0, 0});
    for (std::size_t i = 0; i < points.size(); ++i)
      builder_.addPoint(points[i], static_cast<std::uint32_t>(i + 1));
    Mapper(config_).storeRest(builder_.view(), std::vector<bool>(points.size(), false), features_);
  }
  /// Sees the same points again, with the same tracks, from elsewhere. @return new landmarks
  int seeAgain(const Eigen::Vector3d& from, const std::vector<Eigen::Vector3d>& points) {
    builder_.lookFrom(from);
    std::vector<Association> matches;
    for (std::size_t i = 0; i < points.size(); ++i) {
      builder_.addPoint(points[i], static_cast<std::uint32_t>(i + 1));
      matches.push_back({static_cast<int>(i), static_cast<int>(i)});
    }
    used_.assign(points.size(), false);
    return Mapper(config_).triangulateMatches(builder_.view(), matches, features_, landmarks_,
                                              used_);
  }

  MapperConfig config_;
  ViewBuilder builder_;
  FeatureMap features_{FeatureMapConfig{}};
  LandmarkMap landmarks_{LandmarkMapConfig{}};
  std::vector<bool> used_;
};

TEST_F(MapperTest, FeatureSeenTwiceBecomesALandmark) {
  const std::vector<Eigen::Vector3d> points{{5, 0.5, 0.2}};
  seeFirst(points);
  builder_.setStamp(2'000'000'000);
  ASSERT_EQ(seeAgain({0, -0.5, 0}, points), 1);
  EXPECT_TRUE(used_[0]);
  EXPECT_TRUE(features_.isRemoved(0)) << "matched entries leave the feature map";
  const Landmark& landmark = landmarks_.all()[0];
  EXPECT_LT((landmark.position_map - points[0]).norm(), 1e-5);
  EXPECT_EQ(landmark.times_seen, 2);
  EXPECT_EQ(landmark.track_id, 1U);
  EXPECT_EQ(landmark.last_seen_ns, 2'000'000'000);
  const Eigen::Vector3d from_camera = points[0] - Eigen::Vector3d(0, -0.5, 0);
  const double depth_m = from_camera.norm();
  EXPECT_NEAR(landmark.sigma_m,
              config_.position_sigma_m + depth_m * config_.angle_sigma_px / kFocalLength_px,
              1e-6);  // (5.19)
  EXPECT_LT((landmark.view_direction_map.cast<double>() - from_camera / depth_m).norm(), 1e-6);
  EXPECT_GT(landmark.depth_sigma_m, 5 * landmark.sigma_m);
}

TEST_F(MapperTest, TooLittleParallaxWaits) {
  config_.min_parallax_deg = 2;
  const double enough_m = 5 * std::tan(2.01 * M_PI / 180);
  const double too_little_m = 5 * std::tan(1.99 * M_PI / 180);
  const std::vector<Eigen::Vector3d> points{{5, 0, 0}};
  seeFirst(points);
  EXPECT_EQ(seeAgain({0, too_little_m, 0}, points), 0);
  EXPECT_TRUE(used_[0]) << "the older entry has the longer baseline: no second one of its track";
  EXPECT_FALSE(features_.isRemoved(0));
  EXPECT_EQ(seeAgain({0, enough_m, 0}, points), 1);
}

TEST_F(MapperTest, PointsTooFarAwayAreStoredAnew) {
  config_.max_depth_m = 20;
  config_.min_parallax_deg = 0.5;
  const std::vector<Eigen::Vector3d> points{{30, 0, 0}};
  seeFirst(points);
  EXPECT_EQ(seeAgain({0, 1, 0}, points), 0);
  EXPECT_TRUE(features_.isRemoved(0));
  EXPECT_FALSE(used_[0]);
}

TEST_F(MapperTest, WaitingForParallaxOnlyKeepsFeaturesOfTheSameTrack) {
  seeFirst({{5, 0, 0}});
  builder_.lookFrom({0, 0.001, 0});
  builder_.addPoint({5, 0, 0}, 77);  // matched by descriptor: its own track has no entry yet
  std::vector<bool> used{false};
  EXPECT_EQ(
      Mapper(config_).triangulateMatches(builder_.view(), {{0, 0}}, features_, landmarks_, used),
      0);
  EXPECT_FALSE(used[0]) << "it must be stored, or its track could never be followed";
}

TEST_F(MapperTest, StoresTheRestWithPoseAndSigma) {
  builder_.lookFrom({1, 2, 3});
  builder_.addPoint({5, 2, 3}, 4);
  builder_.addPoint({5, 3, 3}, 6);
  builder_.view().setPositionVariance(0.25, true);
  Mapper(config_).storeRest(builder_.view(), {true, false}, features_);
  ASSERT_EQ(features_.size(), 1U);
  EXPECT_EQ(features_.all()[0].track_id, 6U);
  EXPECT_EQ(features_.all()[0].ray.origin_map, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(features_.all()[0].position_variance_m2, 0.25);
}

// Worked example of (5.20-5.22, 5.30-5.34).
TEST_F(MapperTest, RefinesByAScalarKalmanUpdate) {
  config_.position_sigma_m = 0.02;
  config_.angle_sigma_px = 0.01 * kFocalLength_px;  // sigma_a = 0.01
  Landmark landmark;
  landmark.position_map << 4, 0.3, 0;
  landmark.sigma_m = 0.08F;
  landmarks_.add(landmark);
  builder_.lookFrom({0, 0, 0});
  builder_.addPoint({7, 0, 0}, 9);  // the measured ray is x
  builder_.view().setPositionVariance(0, false);
  Mapper(config_).refine(builder_.view(), {{0, 0}}, landmarks_);
  const double sigma = 0.02 + 4 * 0.01;  // d = 4
  const double gain = 0.0064 / (0.0064 + sigma * sigma);
  const Landmark& refined = landmarks_.all()[0];
  EXPECT_LT((refined.position_map - Eigen::Vector3d(4, 0.3 * (1 - gain), 0)).norm(), 1e-6);
  EXPECT_NEAR(refined.sigma_m, std::sqrt((1 - gain) * 0.0064), 1e-8);
  EXPECT_EQ(refined.track_id, 9U);
  EXPECT_EQ(refined.times_seen, 1);
}

TEST_F(MapperTest, UncertainPoseMovesLandmarksLess) {
  const auto moved = [this](double variance_m2) {
    LandmarkMap map({});
    Landmark landmark;
    landmark.position_map << 4, 0.3, 0;
    landmark.sigma_m = 0.08F;
    map.add(landmark);
    builder_.lookFrom({0, 0, 0});
    builder_.addPoint({7, 0, 0}, 9);
    builder_.view().setPositionVariance(variance_m2, true);
    Mapper(config_).refine(builder_.view(), {{0, 0}}, map);
    return 0.3 - map.all()[0].position_map.y();
  };
  EXPECT_GT(moved(0), 0.2);
  EXPECT_LT(moved(1), 0.01);
}

class BaselineTest : public MapperTest {
 protected:
  /// Makes a landmark by a baseline of 0.1 m, with a wrong depth, and sees it again from 0.5 m.
  /// @return its distance from the truth
  double errorAfterASecondView(double variance_since_m2) {
    const Eigen::Vector3d point(4, 0, 0);
    seeFirst({point});
    seeAgain({0, 0.1, 0}, {point});
    landmarks_.at(0).position_map << 5, 0, 0;
    builder_.lookFrom({0, 0.5, 0});
    builder_.addPoint(point, 1);
    builder_.view().setPositionVariance(variance_since_m2, true);
    Mapper(config_).refine(builder_.view(), {{0, 0}}, landmarks_);
    return (landmarks_.all()[0].position_map - point).norm();
  }
};

TEST_F(BaselineTest, AWiderOneMendsTheDepth) {
  EXPECT_LT(errorAfterASecondView(0), 1e-4);
  EXPECT_NEAR(landmarks_.all()[0].parallax_rad, std::atan(0.5 / 4), 1e-5);
}

TEST_F(BaselineTest, NotWhenTheDriftSinceIsAsLongAsItself) {
  EXPECT_GT(errorAfterASecondView(0.5 * 0.5), 0.5);
}

TEST_F(BaselineTest, NotWhenItHasHardlyGrown) {
  config_.baseline_growth = 10;
  EXPECT_GT(errorAfterASecondView(0), 0.5);
}

TEST_F(MapperTest, DropsWhatIsNotConfirmed) {
  config_.drop_unconfirmed_after = 3;
  Landmark fresh;
  fresh.times_seen = 2;
  Landmark confirmed;
  confirmed.times_seen = 3;
  const std::uint32_t fresh_id = landmarks_.add(fresh);
  const std::uint32_t confirmed_id = landmarks_.add(confirmed);
  const Mapper mapper(config_);
  EXPECT_EQ(mapper.countMissed({0, 1}, landmarks_), 0);
  EXPECT_EQ(mapper.countMissed({0, 1}, landmarks_), 0);
  EXPECT_EQ(mapper.countMissed({0, 1}, landmarks_), 1);
  EXPECT_EQ(landmarks_.find(fresh_id), nullptr);
  ASSERT_NE(landmarks_.find(confirmed_id), nullptr);
  EXPECT_EQ(landmarks_.find(confirmed_id)->times_missed, 3);
}

TEST_F(MapperTest, AMatchForgetsTheMisses) {
  config_.drop_unconfirmed_after = 2;
  Landmark landmark;
  landmark.position_map << 4, 0, 0;
  landmark.sigma_m = 0.1F;
  landmarks_.add(landmark);
  builder_.lookFrom({0, 0, 0});
  builder_.addPoint({4, 0, 0}, 9);
  const Mapper mapper(config_);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(mapper.countMissed({0}, landmarks_), 0);
    mapper.refine(builder_.view(), {{0, 0}}, landmarks_);
  }
  EXPECT_EQ(mapper.countMissed({0}, landmarks_), 0);
  EXPECT_EQ(mapper.countMissed({0}, landmarks_), 1) << "seen twice: not confirmed yet";
}

TEST_F(MapperTest, DropsWhatFailsMuchMoreOftenThanItIsSeen) {
  config_.drop_failing_ratio = 2;
  Landmark seldom;
  seldom.times_seen = 3;
  Landmark often;
  often.times_seen = 30;
  const std::uint32_t seldom_id = landmarks_.add(seldom);
  const std::uint32_t often_id = landmarks_.add(often);
  const Mapper mapper(config_);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(mapper.countFailed({0, 1}, landmarks_), 0) << i;
  EXPECT_EQ(mapper.countFailed({0, 1}, landmarks_), 1);
  EXPECT_EQ(landmarks_.find(seldom_id), nullptr);
  for (int i = 11; i < 64; ++i) EXPECT_EQ(mapper.countFailed({0}, landmarks_), 0) << i;
  EXPECT_NE(landmarks_.find(often_id), nullptr);
  EXPECT_EQ(mapper.countFailed({0}, landmarks_), 1);
  EXPECT_EQ(landmarks_.size(), 0U);
}

TEST_F(MapperTest, ALandmarkThatIsSeenForYearsIsCountedNoFurther) {
  const std::vector<Eigen::Vector3d> points{{5, 0.5, 0.2}};
  seeFirst(points);
  ASSERT_EQ(seeAgain({0, -0.5, 0}, points), 1);
  landmarks_.at(0).times_seen = std::numeric_limits<int>::max();
  Mapper::remember(builder_.view(), {{0, 0}}, landmarks_);
  EXPECT_EQ(landmarks_.all()[0].times_seen, std::numeric_limits<int>::max());
}

}  // namespace
}  // namespace ardrone_vslam
