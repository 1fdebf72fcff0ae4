// SPDX-License-Identifier: BSD-3-Clause
#include "maps/map_merge.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <vector>

#include "ardrone_vslam/rotation.hpp"
#include "support/median.hpp"
#include "support/point_flight.hpp"

namespace ardrone_vslam {
namespace {

using test::Flight;
using test::PointWorld;

constexpr std::uint64_t kSeeds = 12;
constexpr int kFrames = 200;

/// Part of a lap [frames, of 200], and stamps that no other flight has.
Flight arcOf(int begin, int end, double begin_s) {
  const Flight laps = test::lapsFlight(kFrames, 2, 10);
  Flight arc(laps.begin() + begin, laps.begin() + end);
  for (test::FlightPose& pose : arc) pose.stamp_ns += static_cast<std::int64_t>(begin_s * 1e9);
  return arc;
}

/// The map of a flight whose odometry begins at a pose of its own.
SavedMap mapOf(PointWorld& world, const Flight& flight, const Eigen::Isometry3d& T_odom_world,
               std::uint64_t seed, double scale_error = 0) {
  test::DriftConfig drift;
  drift.scale_error = scale_error;
  std::vector<OdometryState> odometry = test::observe(flight, drift, seed);
  for (OdometryState& state : odometry) state.T_odom_base = T_odom_world * state.T_odom_base;
  Slam slam(test::configForDrift(), test::forwardExtrinsics());
  const auto frames = test::film(world, flight);
  for (std::size_t i = 0; i < frames.size(); ++i) slam.process(frames[i], odometry[i]);
  return slam.save().map();
}

Eigen::Isometry3d somewhere(std::uint64_t seed) {
  RandomSource random(seed, 5);
  return Eigen::Translation3d(10 * random.normal3()) *
         Eigen::Isometry3d(rotationAboutZ(random.uniform(-M_PI, M_PI)));
}

/// Squared errors of the anchors' positions over the covariance, mean for each; 3 is honest.
double neesOf(const SavedMap& map, const Flight& flight) {
  double sum = 0;
  for (std::size_t i = 0; i < map.anchors.size(); ++i) {
    for (const test::FlightPose& pose : flight) {
      if (pose.stamp_ns != map.anchors[i].stamp_ns) continue;
      const Eigen::Vector3d error =
          map.anchors[i].T_map_rig.translation() - pose.T_map_base.translation();
      const auto at = static_cast<Eigen::Index>(i) * SavedMap::kAnchor;
      const Eigen::Matrix3d P =
          map.anchor_covariance.block<3, 3>(at, at) + 1e-6 * Eigen::Matrix3d::Identity();
      sum += error.dot(P.inverse() * error);
    }
  }
  return sum / static_cast<double>(map.anchors.size());
}

/// Half of all landmarks are nearer than that to a point of the world.
double medianError_m(const SavedMap& map, const PointWorld& world) {
  std::vector<double> errors_m;
  for (const Landmark& landmark : map.landmarks) {
    double nearest_m = 1e9;
    for (const auto& point : world.points())
      nearest_m = std::min(nearest_m, (point.position_map - landmark.position_map).norm());
    errors_m.push_back(nearest_m);
  }
  return test::median(errors_m);
}

// The flights are 0.55 and 0.6 of a lap and share a quarter of it.
TEST(MapMerge, TwoPartsOfARoomBecomeOne) {
  std::vector<double> apart_m;
  std::vector<double> turned_rad;
  std::vector<double> errors_m;
  std::vector<double> nees;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    PointWorld world = test::pointRoom(seed, 0.1);
    const Flight first = arcOf(0, 110, 0);
    const Flight second = arcOf(60, 180, 1000);
    const Eigen::Isometry3d T_b_world = somewhere(seed);
    const SavedMap a = mapOf(world, first, Eigen::Isometry3d::Identity(), seed);
    const SavedMap b = mapOf(world, second, T_b_world, seed + 100);
    const MapAlignment alignment = align(a, b, pairsOf(a, b));
    ASSERT_FALSE(alignment.is_chance) << seed;
    const MergedMap merged = merge(a, b, alignment);
    const Eigen::Isometry3d off = alignment.T_a_b * T_b_world;
    apart_m.push_back(
        (off * second.front().T_map_base.translation() - second.front().T_map_base.translation())
            .norm());
    turned_rad.push_back(angleOf_rad(off.linear()));
    errors_m.push_back(medianError_m(merged.map, world));
    Flight both = first;
    both.insert(both.end(), second.begin(), second.end());
    nees.push_back(neesOf(merged.map, both));
    EXPECT_EQ(merged.map.landmarks.size(), a.landmarks.size() + b.landmarks.size() - merged.shared);
    EXPECT_GT(merged.shared, 40U) << seed;
    EXPECT_EQ(merged.map.anchors.size(), a.anchors.size() + b.anchors.size());
    EXPECT_GT(alignment.agreed.size(), 40U) << seed;  // measured: 56 to 77
    EXPECT_LT(apart_m.back(), 0.42) << seed;          // 0.03 to 0.28
    EXPECT_LT(nees.back(), 1.3) << seed;              // 0.25 to 0.88
  }
  EXPECT_LT(test::median(apart_m), 0.14);      // 0.099
  EXPECT_LT(test::median(turned_rad), 0.014);  // 0.0103
  EXPECT_LT(test::median(errors_m), 0.17);     // 0.147; of the first map alone 0.13
}

// One map is larger than the room, the other smaller: each says how much it may be, and the truth
// lies between.
TEST(MapMerge, MapsOfTwoScalesMeetInTheMiddle) {
  std::vector<double> before_m;
  std::vector<double> after_m;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    PointWorld world = test::pointRoom(seed, 0.1);
    const SavedMap a = mapOf(world, arcOf(0, 200, 0), Eigen::Isometry3d::Identity(), seed, 0.06);
    const SavedMap b = mapOf(world, arcOf(20, 220, 1000), somewhere(seed), seed + 100, -0.06);
    const MapAlignment alignment = align(a, b, pairsOf(a, b));
    ASSERT_FALSE(alignment.is_chance) << seed;
    before_m.push_back(medianError_m(a, world));
    after_m.push_back(medianError_m(merge(a, b, alignment).map, world));
  }
  EXPECT_LT(test::median(after_m), 0.5 * test::median(before_m));  // 0.134 and 0.332 m
}

TEST(MapMerge, AMapAndOneMadeFromItAreOfOneFlight) {
  PointWorld world = test::pointRoom(4, 0.1);
  const SavedMap a = mapOf(world, arcOf(0, 110, 0), Eigen::Isometry3d::Identity(), 4);
  const SavedMap b = mapOf(world, arcOf(0, 110, 1000), Eigen::Isometry3d::Identity(), 5);
  EXPECT_TRUE(areOfOneFlight(a, a, pairsOf(a, a)));
  EXPECT_FALSE(areOfOneFlight(a, b, pairsOf(a, b)));
}

TEST(MapMerge, AnotherRoomIsRefused) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    PointWorld world = test::pointRoom(seed, 0.1);
    PointWorld other = test::pointRoom(seed + 50, 0.1);
    const SavedMap a = mapOf(world, arcOf(0, 110, 0), Eigen::Isometry3d::Identity(), seed);
    const SavedMap b = mapOf(other, arcOf(0, 110, 1000), somewhere(seed), seed + 100);
    EXPECT_TRUE(align(a, b, pairsOf(a, b)).is_chance) << seed;
    // As many pairs as in the same room, but all of them wrong.
    std::vector<LandmarkPair> pairs;
    for (std::size_t i = 0; i < 300; ++i)
      pairs.push_back({i % a.landmarks.size(), (7 * i + 3) % b.landmarks.size()});
    EXPECT_TRUE(align(a, b, pairs).is_chance) << seed;
  }
}

TEST(MapMerge, AMapIsFoundInItsMovedCopyExactly) {
  PointWorld world = test::pointRoom(3, 0.1);
  const SavedMap a = mapOf(world, arcOf(0, 110, 0), Eigen::Isometry3d::Identity(), 3);
  const Eigen::Isometry3d T = somewhere(3);
  SavedMap b = a;
  for (Landmark& landmark : b.landmarks) landmark.position_map = T * landmark.position_map;
  for (MapAnchor& anchor : b.anchors) anchor.T_map_rig = T * anchor.T_map_rig;
  const MapAlignment alignment = align(a, b, pairsOf(a, b));
  EXPECT_FALSE(alignment.is_chance);
  EXPECT_TRUE((alignment.T_a_b * T).matrix().isIdentity(1e-9));
}

TEST(MapMerge, MapsOfTwoCamerasOrWithTooManyAnchorsAreRefused) {
  SavedMap a;
  a.cameras = {{640, 360, 560}};
  SavedMap b = a;
  b.cameras[0].width_px = 320;
  EXPECT_NE(mergeFault(a, b).find("two cameras"), std::string::npos);
  EXPECT_THROW(merge(a, b, {}), MapFileError);
  b = a;
  EXPECT_EQ(mergeFault(a, b), "");
  b.anchors.resize(kMostMergedAnchors + 1);
  EXPECT_NE(mergeFault(a, b).find("crop or prune"), std::string::npos);
}

}  // namespace
}  // namespace ardrone_vslam
