// SPDX-License-Identifier: BSD-3-Clause
#include "map/landmark_columns.hpp"

#include <gtest/gtest.h>

#include "map/landmark_map.hpp"
#include "simulation/random_source.hpp"
#include "support/view_builder.hpp"

namespace ardrone_vslam {
namespace {

class LandmarkColumnsTest : public ::testing::Test {
 protected:
  /// 300 landmarks about a place, seen from near it.
  void fill(const Eigen::Vector3d& place_map) {
    for (int i = 0; i < 300; ++i) map_.add(someLandmark(place_map));
  }
  Landmark someLandmark(const Eigen::Vector3d& place_map) {
    Landmark landmark;
    landmark.position_map = place_map + 10 * random_.normal3();
    const Eigen::Vector3d offset = landmark.position_map - place_map - random_.normal3();
    landmark.view_direction_map = offset.normalized().cast<float>();
    landmark.seen_distance_m = static_cast<float>(offset.norm());
    landmark.height_m = static_cast<float>(random_.normal());
    landmark.track_id = static_cast<std::uint32_t>(random_.integer(1, 1000));
    landmark.position_variance_m2 = static_cast<float>(random_.uniform());
    landmark.anchor_id = static_cast<std::uint32_t>(1 + map_.size() % 7);
    return landmark;
  }
  void lookFrom(const Eigen::Vector3d& position_map, bool planar = false) {
    builder_.lookFrom(position_map, planar);
    builder_.addFrame();
  }
  /// Holds the columns against the map, in double precision.
  void expectProjectionsAsOfTheMap(double tolerance_px) {
    const FrameView& view = builder_.view();
    const LandmarkColumns& columns = map_.columns(view.origin_map());
    ASSERT_EQ(columns.size(), map_.size());
    columns.project(view, {180, 1e6}, visible_);
    std::size_t k = 0;
    for (std::size_t i = 0; i < map_.size(); ++i) {
      const Landmark& landmark = map_.all()[i];
      EXPECT_EQ(columns.trackId(i), landmark.track_id);
      EXPECT_EQ(columns.positionVariance_m2(i), landmark.position_variance_m2);
      EXPECT_EQ(columns.anchorId(i), landmark.anchor_id);
      EXPECT_NEAR(columns.seenDistance_m(i), landmark.seen_distance_m, 1e-4);
      const Eigen::Vector3d offset = landmark.position_map - view.origin_map();
      Eigen::Vector2f pixel_px;
      if (!view.idealPixel(offset, landmark.height_m / offset.norm(), pixel_px)) continue;
      ASSERT_LT(k, visible_.count);
      ASSERT_EQ(visible_.index[k], static_cast<int>(i));
      EXPECT_LT((visible_.pixel_px(k) - pixel_px).norm(), tolerance_px);
      EXPECT_NEAR(visible_.distance_m[k], offset.norm(), 1e-4);
      ++k;
    }
    EXPECT_EQ(k, visible_.count);
    EXPECT_GT(k, 10U);
  }
  std::size_t visibleWith(double max_view_angle_deg, double max_distance_ratio) {
    const FrameView& view = builder_.view();
    map_.columns(view.origin_map())
        .project(view, {max_view_angle_deg, max_distance_ratio}, visible_);
    return visible_.count;
  }

  RandomSource random_{17};
  LandmarkMap map_{LandmarkMapConfig{}};
  test::ViewBuilder builder_;
  VisibleLandmarks visible_;
};

TEST_F(LandmarkColumnsTest, ProjectAsTheViewDoes) {
  fill({0, 0, 0});
  lookFrom({-3, 1, 0.5});
  expectProjectionsAsOfTheMap(0.01);
}

TEST_F(LandmarkColumnsTest, StayPreciseKilometresFromTheOrigin) {
  fill({9000, -7000, 300});
  lookFrom({8997, -6999, 299});
  expectProjectionsAsOfTheMap(0.05);
  map_.add(someLandmark({0, 0, 0}));
  lookFrom({8990, -7000, 299});
  expectProjectionsAsOfTheMap(0.05);
}

TEST_F(LandmarkColumnsTest, FollowTheMapAsItChanges) {
  fill({0, 0, 0});
  for (int round = 0; round < 20; ++round) {
    lookFrom({-3.0 + 30 * round, 0, 0});  // the origin moves with the camera, after 256 m
    for (int i = 0; i < 200; ++i) {
      map_.add(someLandmark(builder_.view().origin_map()));
      map_.remove(static_cast<std::uint32_t>(random_.integer(1, 300 + 200 * round)));
      Landmark& changed =
          map_.at(static_cast<std::size_t>(random_.integer(0, static_cast<int>(map_.size()) - 1)));
      const std::uint32_t id = changed.id;
      changed = someLandmark(builder_.view().origin_map());
      changed.id = id;
    }
    map_.remove(map_.all().back().id);
    expectProjectionsAsOfTheMap(0.01);
  }
}

TEST_F(LandmarkColumnsTest, PlanarLandmarksAreAtTheirHeight) {
  fill({0, 0, 0});
  for (std::size_t i = 0; i < map_.size(); ++i) {
    map_.at(i).position_map.z() = 0;
    map_.at(i).view_direction_map.z() = 0;
  }
  lookFrom({-3, 1, 0}, true);
  expectProjectionsAsOfTheMap(0.01);
}

TEST_F(LandmarkColumnsTest, CullByDirectionAndDistance) {
  for (const double distance_m : {2.0, 8.0, 33.0}) {
    Landmark landmark;
    landmark.position_map << distance_m, 0, 0;
    landmark.view_direction_map << std::cos(0.6F), std::sin(0.6F), 0;  // 34 degrees off
    landmark.seen_distance_m = 8;
    map_.add(landmark);
  }
  lookFrom({0, 0, 0});
  EXPECT_EQ(visibleWith(35, 10), 3U);
  EXPECT_EQ(visibleWith(34, 10), 0U);
  EXPECT_EQ(visibleWith(35, 4.1), 2U);
  EXPECT_EQ(visibleWith(35, 3.9), 1U);
  for (std::size_t i = 0; i < 3; ++i) map_.at(i).seen_distance_m = 0;
  EXPECT_EQ(visibleWith(35, 1), 3U) << "from where they were seen is not known";
  for (std::size_t i = 0; i < 3; ++i) map_.at(i).view_direction_map *= -1;
  EXPECT_EQ(visibleWith(145, 10), 0U);
  EXPECT_EQ(visibleWith(147, 10), 3U);
}

}  // namespace
}  // namespace ardrone_vslam
