// SPDX-License-Identifier: BSD-3-Clause
// What rviz draws of state and map.
#include "conversions/markers.hpp"

#include <gtest/gtest.h>

#include <map>

#include "conversions/conversions.hpp"

namespace ardrone_vslam {
namespace {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

constexpr std::int64_t kShown_ns = 5'000'000'000;

Landmark landmarkAt(std::uint32_t id, const Eigen::Vector3d& position_map) {
  Landmark landmark;
  landmark.id = id;
  landmark.position_map = position_map;
  landmark.sigma_m = 0.02F;
  return landmark;
}

/// @param distance_m  of all from the origin
std::vector<Landmark> mapOf(std::uint32_t count, double distance_m) {
  std::vector<Landmark> map;
  for (std::uint32_t id = 1; id <= count; ++id) {
    const double angle = 0.1 * id;
    map.push_back(
        landmarkAt(id, distance_m * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0)));
  }
  return map;
}

Status statusOf(std::uint8_t state, const std::string& name, const std::string& reason) {
  Status status;
  status.header.stamp = toRosTime(kShown_ns);
  status.header.frame_id = "map";
  status.state = state;
  status.state_name = name;
  status.reason = reason;
  status.deviation = 0.0312;
  return status;
}

TEST(StateMarkers, TextSaysStateDeviationAndReasonInShortLines) {
  const std::string reason =
      "the odometry's scale and the images' contradict each other since the camera was turned";
  const Marker text =
      toStateMarkers(statusOf(Status::FIX_REJECTED, "fix_rejected", reason), {1, 2, 3}, {})
          .markers[0];
  EXPECT_EQ(text.type, Marker::TEXT_VIEW_FACING);
  EXPECT_EQ(text.header.frame_id, "map");
  EXPECT_EQ(text.text.substr(0, text.text.find('\n')), "fix rejected, +-0.031 m");
  std::istringstream lines(text.text);
  std::string joined;
  for (std::string line; std::getline(lines, line); joined += line + ' ')
    EXPECT_LE(line.size(), 45U);
  EXPECT_NE(joined.find(reason), std::string::npos);
  EXPECT_EQ(text.pose.position.x, 1);
  EXPECT_GT(text.pose.position.z, 3);
}

TEST(StateMarkers, ColoursTellGoodDoubtfulAndBad) {
  const auto colour = [](std::uint8_t state) {
    return toStateMarkers(statusOf(state, "", ""), Eigen::Vector3d::Zero(), {}).markers[0].color;
  };
  for (const std::uint8_t good : {Status::LOCALISED, Status::TRACKING, Status::RESTING})
    EXPECT_TRUE(colour(good).g > 0.9F && colour(good).r < 0.5F) << int(good);
  for (const std::uint8_t doubtful : {Status::SEARCHING_MAP, Status::WAITING_FOR_ODOMETRY})
    EXPECT_TRUE(colour(doubtful).g > 0.8F && colour(doubtful).r > 0.9F) << int(doubtful);
  for (const std::uint8_t bad : {Status::DISTRUSTED, Status::BLIND, Status::DRONE_SILENT})
    EXPECT_TRUE(colour(bad).g < 0.5F && colour(bad).r > 0.9F) << int(bad);
}

TEST(StateMarkers, LinesGoToTheLandmarksThatThisImageHasShownAgain) {
  std::vector<Landmark> map = mapOf(4, 4);
  map[1].last_seen_ns = map[2].last_seen_ns = map[3].last_seen_ns = kShown_ns;
  map[3].first_seen_ns = kShown_ns;  // made by it
  const Eigen::Vector3d base_map(0.5, 0, 1);
  const auto markers =
      toStateMarkers(statusOf(Status::LOCALISED, "localised", ""), base_map, map).markers;
  ASSERT_EQ(markers[1].points.size(), 2U);
  EXPECT_EQ(markers[1].points[1].y, map[2].position_map.y());
  ASSERT_EQ(markers[2].points.size(), 4U);
  EXPECT_EQ(markers[2].type, Marker::LINE_LIST);
  EXPECT_EQ(markers[2].points[2].z, 1);
  EXPECT_EQ(markers[2].points[3].x, map[2].position_map.x());
}

TEST(StateMarkers, WithoutLandmarksInUseTheirMarkersGo) {
  const auto markers =
      toStateMarkers(statusOf(Status::TRACKING, "tracking", ""), {0, 0, 0}, mapOf(4, 4)).markers;
  EXPECT_EQ(markers[0].action, Marker::ADD);
  EXPECT_EQ(markers[1].action, Marker::DELETE);
  EXPECT_EQ(markers[2].action, Marker::DELETE);
}

TEST(DrawnScale, FollowsTheDistanceOfTheLandmarks) {
  const Eigen::Vector3d origin(0, 0, 0);
  EXPECT_EQ(drawnScale({}, origin), 1);
  EXPECT_EQ(drawnScale(mapOf(1000, 4), origin), 1);
  EXPECT_EQ(drawnScale(mapOf(1000, 66), origin), 16);
  EXPECT_EQ(drawnScale(mapOf(1, 1e5), origin), 16);
  EXPECT_EQ(drawnScale(mapOf(1, 1e-3), origin), 0.5);
}

TEST(DrawnScale, IsKeptWhileItDoesNearlyAsWell) {
  const Eigen::Vector3d origin(0, 0, 0);
  EXPECT_EQ(drawnScale(mapOf(10, 6.5), origin), 2);
  EXPECT_EQ(drawnScale(mapOf(10, 6.5), origin, 1), 1);
  EXPECT_EQ(drawnScale(mapOf(10, 5), origin, 2), 2);
  EXPECT_EQ(drawnScale(mapOf(10, 7), origin, 1), 2);
}

TEST(SigmaColour, GetsBluerWithTheSigma) {
  EXPECT_EQ(colourOfSigma(0.001).r, 1);  // white
  EXPECT_EQ(colourOfSigma(0.01).g, 1);
  EXPECT_GT(colourOfSigma(0.05).r, colourOfSigma(0.1).r);
  EXPECT_EQ(colourOfSigma(5).r, 0);
  EXPECT_LT(colourOfSigma(1).g, 0.3F);
  EXPECT_EQ(colourOfSigma(1).b, 1);
}

/// As a viewer has them.
class Viewer {
 public:
  void take(const MarkerArray& array) {
    for (const Marker& marker : array.markers) {
      if (marker.action == Marker::DELETE) {
        shown_.erase(marker.id);
      } else {
        EXPECT_FALSE(marker.points.empty());
        shown_[marker.id] = marker;
      }
    }
  }
  std::size_t points() const {
    std::size_t sum = 0;
    for (const auto& [id, marker] : shown_) sum += marker.points.size();
    return sum;
  }
  double farthest_m(const std::vector<Landmark>& map) const {
    double most_m = 0;
    for (std::size_t i = 0; i < map.size(); ++i) {
      const auto& point = shown_.at(static_cast<int>(i / LandmarkMarkers::kBlock))
                              .points[i % LandmarkMarkers::kBlock];
      most_m = std::max(most_m,
                        (Eigen::Vector3d(point.x, point.y, point.z) - map[i].position_map).norm());
    }
    return most_m;
  }

 private:
  std::map<int, Marker> shown_;
};

class LandmarkMarkersTest : public ::testing::Test {
 protected:
  /// @return how many markers were sent
  std::size_t update() {
    const MarkerArray array = markers_.changes(map_, {}, Eigen::Vector3d::Zero());
    viewer_.take(array);
    return array.markers.size();
  }

  std::vector<Landmark> map_ = mapOf(1000, 4);
  LandmarkMarkers markers_;
  Viewer viewer_;
};

TEST_F(LandmarkMarkersTest, OfWhatIsDrawnOneBlockIsSentAgainAndThoseThatLookOtherwise) {
  EXPECT_EQ(update(), 4U);
  EXPECT_EQ(viewer_.points(), 1000U);
  EXPECT_EQ(update(), 1U);             // the second block
  map_[300].position_map.x() += 0.01;  // less than can be seen
  map_[700].sigma_m = 0.0215F;
  EXPECT_EQ(update(), 1U);  // the third
  map_[300].position_map.x() += 0.02;
  EXPECT_EQ(update(), 2U);  // and the fourth
  map_[700].sigma_m = 0.05F;
  EXPECT_EQ(update(), 2U);  // and the first
  map_[10] = map_.back();   // as LandmarkMap removes
  map_.pop_back();
  EXPECT_EQ(update(), 3U);  // the first, the last, and the second
  EXPECT_LT(viewer_.farthest_m(map_), 0.025);
}

TEST_F(LandmarkMarkersTest, OfSigmasBeyondTheColoursNothingIsSent) {
  for (Landmark& landmark : map_) landmark.sigma_m = 0;
  update();
  EXPECT_EQ(update(), 1U);
  for (Landmark& landmark : map_) landmark.sigma_m = 0.005F;
  EXPECT_EQ(update(), 1U);
}

TEST_F(LandmarkMarkersTest, WhatIsGoneIsTakenAwayAlsoWhenTheScaleIsAnotherOne) {
  update();
  map_.resize(500);
  update();
  EXPECT_EQ(viewer_.points(), 500U);
  for (Landmark& landmark : map_) landmark.position_map *= 10;
  EXPECT_EQ(update(), 2U) << "larger now";
  map_ = mapOf(100, 4);
  markers_.forget();
  update();
  EXPECT_EQ(viewer_.points(), 100U);
  map_.clear();
  update();
  EXPECT_EQ(viewer_.points(), 0U);
}

TEST_F(LandmarkMarkersTest, AViewerThatIsNewGetsAllAndAResetOneAfterSomeTime) {
  update();
  viewer_ = Viewer();
  markers_.forget();
  update();
  EXPECT_EQ(viewer_.points(), 1000U);
  viewer_ = Viewer();
  for (int i = 0; i < 4; ++i) update();
  EXPECT_EQ(viewer_.points(), 1000U);
}

TEST_F(LandmarkMarkersTest, AHundredThousandComeInParts) {
  map_ = mapOf(100'000, 4);
  std::size_t calls = 0;
  for (; viewer_.points() < map_.size() && calls < 100; ++calls)
    EXPECT_LE(update(), LandmarkMarkers::kMostBlocks);
  EXPECT_EQ(calls, 7U);  // 391 blocks
  map_[99'999].position_map.z() = 1;
  for (calls = 0; viewer_.farthest_m(map_) > 0.025 && calls < 100; ++calls) update();
  EXPECT_LE(calls, 7U);
}

}  // namespace
}  // namespace ardrone_vslam
