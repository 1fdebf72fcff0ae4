// SPDX-License-Identifier: BSD-3-Clause
// A map that outlives its flight: another flight is found in it, from wherever it begins.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <optional>

#include "support/median.hpp"
#include "support/point_flight.hpp"

namespace ardrone_vslam {
namespace {

using test::Flight;
using test::PointWorld;

constexpr double kMapRate_hz = 10;
constexpr std::uint64_t kMapSeeds = 20;

/// Two laps of a room, and the map that they leave.
SavedMap mapOf(PointWorld& world, std::uint64_t seed) {
  const Flight flight = test::lapsFlight(200, 2, kMapRate_hz);
  const auto odometry = test::observe(flight, {}, seed);
  Slam slam(test::configForDrift(), test::forwardExtrinsics());
  const auto frames = test::film(world, flight);
  for (std::size_t i = 0; i < frames.size(); ++i) slam.process(frames[i], odometry[i]);
  return slam.save().map();
}

/// On another circle, the other way round, from anywhere on it.
Flight anotherFlight(std::uint64_t seed) {
  RandomSource random(seed, 3);
  const Flight laps = test::lapsFlight(200, 2, kMapRate_hz, 2.2, 1.4);
  const int start = random.integer(0, 199);
  Flight flight;
  for (int i = 0; i < 150; ++i) {
    test::FlightPose pose = laps[static_cast<std::size_t>(200 + start - i)];
    pose.T_map_base.rotate(Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitZ()));
    pose.stamp_ns = test::stampOf(i, kMapRate_hz);
    flight.push_back(pose);
  }
  return flight;
}

/// Its odometry, which begins at another origin and heading.
std::vector<OdometryState> odometryOf(const Flight& flight, std::uint64_t seed) {
  RandomSource random(seed, 4);
  const Eigen::Isometry3d T_odom_map =
      Eigen::Translation3d(10 * random.normal3()) *
      Eigen::AngleAxisd(random.uniform(-M_PI, M_PI), Eigen::Vector3d::UnitZ());
  std::vector<OdometryState> states = test::observe(flight, {}, seed + 1000);
  for (OdometryState& state : states) state.T_odom_base = T_odom_map * state.T_odom_base;
  return states;
}

struct Again {
  std::optional<std::size_t> found_frame;
  double rmse_m = 0;  // once found
  double nees = 0;    // mean, 3 is honest
  SavedMap map;
  FrameResult last;
};

/// @param x_m  the map's flight was so far along x
Again flyAgain(PointWorld& world, const Flight& flight, const SavedMap& map, std::uint64_t seed,
               const SlamConfig& config = test::configForDrift(),
               const std::optional<PlaceHint>& hint = std::nullopt, double x_m = 0) {
  const auto odometry = odometryOf(flight, seed);
  const auto frames = test::film(world, flight);
  Slam slam(config, test::forwardExtrinsics());
  slam.load(map);
  if (hint) slam.lookNear(*hint);
  Again again;
  double squares_m2 = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const FrameResult& result = slam.process(frames[i], odometry[i]);
    if (slam.isSearching()) continue;
    if (!again.found_frame) again.found_frame = i;
    const Eigen::Vector3d error = result.T_map_base.translation() -
                                  flight[i].T_map_base.translation() -
                                  x_m * Eigen::Vector3d::UnitX();
    squares_m2 += error.squaredNorm();
    again.nees += error.dot(result.covariance.topLeftCorner<3, 3>().inverse() * error);
  }
  if (again.found_frame) {
    const auto count = static_cast<double>(frames.size() - *again.found_frame);
    again.rmse_m = std::sqrt(squares_m2 / count);
    again.nees /= count;
  }
  again.map = slam.save().map();
  again.last = slam.process(world.look(flight.back().T_map_base * test::forwardExtrinsics(),
                                       flight.back().stamp_ns + 100'000'000),
                            [&] {
                              OdometryState next = odometry.back();
                              next.stamp_ns += 100'000'000;
                              return next;
                            }());
  return again;
}

TEST(MapFlight, IsFoundFromAnyStartAndHeading) {
  std::vector<double> frames_until_found;
  std::vector<double> errors_m;
  std::vector<double> nees;
  for (std::uint64_t seed = 1; seed <= kMapSeeds; ++seed) {
    PointWorld world = test::pointRoom(seed, 0.1);
    const SavedMap map = mapOf(world, seed);
    const Again again = flyAgain(world, anotherFlight(seed), map, seed);
    ASSERT_TRUE(again.found_frame) << seed;
    frames_until_found.push_back(static_cast<double>(*again.found_frame));
    errors_m.push_back(again.rmse_m);
    nees.push_back(again.nees);
    EXPECT_LT(again.rmse_m, 0.155) << seed;  // measured: 0.04 to 0.105
  }
  std::printf("found after %.0f frames, error %.3f m, nees %.2f (medians)\n",
              test::median(frames_until_found), test::median(errors_m), test::median(nees));
  EXPECT_LE(test::median(frames_until_found), 8);  // measured: 6
  EXPECT_LT(test::median(errors_m), 0.1);          // measured: 0.07
  EXPECT_LT(test::median(nees), 1.8);              // 3 is honest; measured: 1.2
}

TEST(MapFlight, LocaliseOnlyLeavesTheMapAsItIs) {
  SlamConfig config = test::configForDrift();
  config.msckf.localise_only = true;
  std::vector<double> errors_m;
  std::vector<double> nees;
  for (std::uint64_t seed = 1; seed <= kMapSeeds; ++seed) {
    PointWorld world = test::pointRoom(seed, 0.1);
    const SavedMap map = mapOf(world, seed);
    const Again again = flyAgain(world, anotherFlight(seed), map, seed, config);
    ASSERT_TRUE(again.found_frame) << seed;
    errors_m.push_back(again.rmse_m);
    nees.push_back(again.nees);
    ASSERT_EQ(again.map.landmarks.size(), map.landmarks.size());
    for (std::size_t i = 0; i < map.landmarks.size(); ++i) {
      ASSERT_EQ(again.map.landmarks[i].position_map, map.landmarks[i].position_map);
      ASSERT_EQ(again.map.landmarks[i].descriptor, map.landmarks[i].descriptor);
    }
    ASSERT_EQ(again.map.anchors.size(), map.anchors.size());
    for (std::size_t i = 0; i < map.anchors.size(); ++i)
      ASSERT_EQ(again.map.anchors[i].T_map_rig.matrix(), map.anchors[i].T_map_rig.matrix());
    EXPECT_LT((again.map.anchor_covariance - map.anchor_covariance).cwiseAbs().maxCoeff(), 1e-12);
  }
  std::printf("error %.3f m, nees %.2f (medians)\n", test::median(errors_m), test::median(nees));
  EXPECT_LT(test::median(errors_m), 0.11);  // measured: 0.077
  EXPECT_LT(test::median(nees), 1.8);       // 3 is honest; measured: 0.93
  EXPECT_GT(test::median(nees), 0.4);
}

TEST(MapFlight, LocaliseOnlyFindsItsMapAgainAsItWas) {
  SlamConfig config = test::configForDrift();
  config.msckf.localise_only = true;
  PointWorld world = test::pointRoom(1, 0.1);
  const SavedMap map = mapOf(world, 1);
  const Flight flight = anotherFlight(1);
  const auto odometry = odometryOf(flight, 1);
  const auto frames = test::film(world, flight);
  Slam slam(config, test::forwardExtrinsics());
  slam.load(map);
  std::size_t found = 0;
  double sigma_m = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    constexpr std::size_t kAnew = 70;
    if (i == kAnew) {
      ASSERT_FALSE(slam.isSearching());
      PlaceHint anywhere;
      anywhere.position_sigma_m = 10;
      anywhere.heading_sigma_rad = 4;
      slam.lookNear(anywhere);
    }
    sigma_m = slam.process(frames[i], odometry[i]).sigma_m;
    if (i >= kAnew && !slam.isSearching()) ++found;
  }
  EXPECT_GT(found, 60U);
  EXPECT_GT(sigma_m, 0.02) << "the map's errors still count";
  const SavedMap after = slam.save().map();
  ASSERT_EQ(after.landmarks.size(), map.landmarks.size());
  for (std::size_t i = 0; i < map.landmarks.size(); ++i) {
    EXPECT_EQ(after.landmarks[i].position_map, map.landmarks[i].position_map);
    EXPECT_EQ(after.landmarks[i].anchor_id, map.landmarks[i].anchor_id);
  }
  EXPECT_EQ(after.anchor_covariance, map.anchor_covariance);
}

/// A writer's thread makes the file's map of it while the flight changes its own.
TEST(MapFlight, ASnapshotStaysWhatItWas) {
  PointWorld world = test::pointRoom(1);
  const Flight flight = test::lapsFlight(200, 2, kMapRate_hz);
  const auto odometry = test::observe(flight, {}, 1);
  Slam slam(test::configForDrift(), test::forwardExtrinsics());
  const auto frames = test::film(world, flight);
  MapSnapshot snapshot;
  SavedMap at_once;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    slam.process(frames[i], odometry[i]);
    if (i != 150) continue;
    snapshot = slam.save();
    at_once = slam.save().map();
  }
  const SavedMap later = std::move(snapshot).map();
  ASSERT_EQ(later.landmarks.size(), at_once.landmarks.size());
  ASSERT_GT(later.landmarks.size(), 100U);
  EXPECT_EQ(later.anchors.size(), at_once.anchors.size());
  EXPECT_EQ(later.anchor_covariance, at_once.anchor_covariance);
  ASSERT_GE(slam.landmarks().size(), later.landmarks.size());
  std::size_t moved = 0;
  for (std::size_t i = 0; i < later.landmarks.size(); ++i) {
    const Landmark& one = later.landmarks[i];
    ASSERT_EQ(one.position_map, at_once.landmarks[i].position_map) << i;
    ASSERT_EQ(one.times_seen, at_once.landmarks[i].times_seen) << i;
    ASSERT_EQ(one.anchor_id, at_once.landmarks[i].anchor_id) << i;
    moved += one.times_seen != slam.landmarks()[i].times_seen ? 1 : 0;
  }
  EXPECT_GT(moved, 50U) << "the flight went on with the same landmarks";
}

/// The map of two rooms that are equal in all, this far apart.
constexpr double kTwin_m = 30;

SavedMap twins(const SavedMap& map) {
  SavedMap both = map;
  const Eigen::Index n = map.anchor_covariance.rows();
  both.anchor_covariance.setZero(2 * n, 2 * n);
  both.anchor_covariance.topLeftCorner(n, n) = map.anchor_covariance;
  both.anchor_covariance.bottomRightCorner(n, n) = map.anchor_covariance;
  for (MapAnchor anchor : map.anchors) {
    anchor.T_map_rig.translation().x() += kTwin_m;
    both.anchors.push_back(anchor);
  }
  for (Landmark landmark : map.landmarks) {
    landmark.id += 1'000'000;
    landmark.position_map.x() += kTwin_m;
    landmark.anchor_id += static_cast<std::uint32_t>(map.anchors.size());
    both.landmarks.push_back(landmark);
  }
  return both;
}

/// By the first image, with the error of a click.
PlaceHint clickNear(const Flight& flight, double x_m) {
  const Eigen::Isometry3d& T = flight.front().T_map_base;
  PlaceHint hint;
  hint.position_map_m = T.translation().head<2>() + Eigen::Vector2d(x_m + 0.6, -0.4);
  hint.heading_rad = std::atan2(T.linear()(1, 0), T.linear()(0, 0)) + 0.3;
  return hint;
}

TEST(MapFlight, AHintTellsWhichOfTwoRoomsThatAreEqual) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    PointWorld world = test::pointRoom(seed, 0.1);
    const SavedMap map = twins(mapOf(world, seed));
    const Flight flight = anotherFlight(seed);
    EXPECT_FALSE(flyAgain(world, flight, map, seed).found_frame) << "by chance alone";
    for (const double x_m : {0.0, kTwin_m}) {
      const Again again =
          flyAgain(world, flight, map, seed, test::configForDrift(), clickNear(flight, x_m), x_m);
      ASSERT_TRUE(again.found_frame) << seed;
      EXPECT_LT(*again.found_frame, 15U) << seed;
      EXPECT_LT(again.rmse_m, 0.155) << seed;  // as without the twin
    }
    PlaceHint turned = clickNear(flight, 0);
    turned.heading_rad += 2;
    for (const PlaceHint& wrong : {clickNear(flight, kTwin_m / 2), turned})
      EXPECT_FALSE(flyAgain(world, flight, map, seed, test::configForDrift(), wrong).found_frame)
          << seed;
  }
}

TEST(MapFlight, AHintInFlightBeginsTheSearchAnew) {
  PointWorld world = test::pointRoom(1);
  const Flight flight = test::lapsFlight(200, 2, kMapRate_hz);
  const auto odometry = test::observe(flight, {}, 1);
  const auto frames = test::film(world, flight);
  Slam slam(test::configForDrift(), test::forwardExtrinsics());
  EXPECT_THROW(slam.lookNear({}), std::invalid_argument) << "there is no map";
  EXPECT_TRUE(slam.save().map().landmarks.empty());
  std::size_t i = 0;
  for (; i < 250; ++i) slam.process(frames[i], odometry[i]);
  slam.lookNear(clickNear({flight[i]}, 0));
  std::size_t searched = 0;
  double worst_m = 0;
  for (; i < frames.size(); ++i) {
    const FrameResult& result = slam.process(frames[i], odometry[i]);
    if (slam.isSearching()) {
      EXPECT_EQ(result.state, SlamState::kSearchingMap);
      ++searched;
      continue;
    }
    worst_m = std::max(
        worst_m, (result.T_map_base.translation() - flight[i].T_map_base.translation()).norm());
  }
  EXPECT_GE(searched, 4U);
  EXPECT_LT(searched, 15U);
  EXPECT_LT(worst_m, 0.3);
}

TEST(MapFlight, AnotherRoomIsNotTakenForTheMaps) {
  for (std::uint64_t seed = 1; seed <= kMapSeeds; ++seed) {
    PointWorld world = test::pointRoom(seed, 0.1);
    const SavedMap map = mapOf(world, seed);
    PointWorld other = test::pointRoom(seed + 100, 0.1);
    const Again elsewhere = flyAgain(other, anotherFlight(seed), map, seed);
    EXPECT_FALSE(elsewhere.found_frame) << seed;
    EXPECT_EQ(elsewhere.last.state, SlamState::kSearchingMap);
    EXPECT_GT(elsewhere.last.sigma_m, 100) << "the place is not known";
  }
}

TEST(MapFlight, PointsThatLookAlikeElsewhereAreNoPlace) {
  for (std::uint64_t seed = 1; seed <= kMapSeeds; ++seed) {
    PointWorld world = test::pointRoom(seed, 0.1);
    const SavedMap map = mapOf(world, seed);
    world.exchangeDescriptors(1);
    EXPECT_FALSE(flyAgain(world, anotherFlight(seed), map, seed).found_frame) << seed;
  }
}

TEST(MapFlight, TheSameCupboardInAnotherRoomIsNoPlace) {
  for (std::uint64_t seed = 1; seed <= kMapSeeds; ++seed) {
    PointWorld world = test::roomWithCupboard(seed, false);
    const SavedMap map = mapOf(world, seed);
    EXPECT_TRUE(flyAgain(world, anotherFlight(seed), map, seed).found_frame) << seed;
    PointWorld other = test::roomWithCupboard(seed, true);
    EXPECT_FALSE(flyAgain(other, anotherFlight(seed), map, seed).found_frame) << seed;
  }
}

TEST(MapFlight, AFileKeepsAllThatAFlightNeeds) {
  PointWorld world = test::pointRoom(1, 0.1);
  const SavedMap map = mapOf(world, 1);
  EXPECT_GT(map.landmarks.size(), 510U);  // measured: 777
  EXPECT_GT(map.anchors.size(), 19U);     // measured: 30
  EXPECT_EQ(map.anchor_covariance.rows(),
            SavedMap::kAnchor * static_cast<Eigen::Index>(map.anchors.size()));
  for (const Landmark& landmark : map.landmarks) {
    ASSERT_GE(landmark.anchor_id, 1U);
    ASSERT_LE(landmark.anchor_id, map.anchors.size());
  }
}

TEST(MapFlight, TheThesisHasNoMapsToLoad) {
  Slam slam(test::thesisConfig(), test::forwardExtrinsics());
  EXPECT_THROW(slam.load({}), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(slam.save().map()), std::invalid_argument);
}

}  // namespace
}  // namespace ardrone_vslam
