// SPDX-License-Identifier: BSD-3-Clause
// `estimator: msckf` after 30 s without an image, while the odometry drifts by metres.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "support/point_flight.hpp"

namespace ardrone_vslam {
namespace {

using test::Flight;
using test::FlightRun;
using test::PointWorld;

constexpr double kRelocationRate_hz = 10;
constexpr std::size_t kSeen = 300;   // frames: one and a half laps
constexpr std::size_t kBlind = 300;  // 30 s
constexpr std::size_t kAgain = 160;
constexpr std::size_t kAgainFrom = kSeen + kBlind;

/// Laps; then on the other side of the room, on another circle and turned outwards.
Flight flightWithABlindStretch() {
  const Flight seen = test::lapsFlight(200, 4, kRelocationRate_hz);
  const Flight other = test::lapsFlight(200, 4, kRelocationRate_hz, 1.8, 1.5);
  Flight flight(seen.begin(), seen.begin() + kSeen + kBlind / 2);
  flight.insert(flight.end(), other.begin() + kSeen + kBlind / 2,
                other.begin() + kSeen + kBlind + kAgain);
  for (std::size_t i = kAgainFrom; i < flight.size(); ++i)
    flight[i].T_map_base.rotate(Eigen::AngleAxisd(-0.3, Eigen::Vector3d::UnitZ()));
  return flight;
}

/// While blind the odometry drifts by 2.1 m and turns by some degrees.
std::vector<OdometryState> observeDrifting(const Flight& flight, std::uint64_t seed,
                                           double yaw_deg) {
  std::vector<OdometryState> odometry = test::observe(flight, {}, seed);
  RandomSource random(seed, 5);
  const double heading = random.uniform(0, 2 * M_PI);
  const Eigen::Vector3d drift_m(1.9 * std::cos(heading), 1.9 * std::sin(heading),
                                random.chance(0.5) ? 0.8 : -0.8);
  for (std::size_t i = kSeen; i < flight.size(); ++i) {
    const double share =
        std::min(1.0, static_cast<double>(i - kSeen) / static_cast<double>(kBlind));
    odometry[i].T_odom_base.translation() += share * drift_m;
    odometry[i].T_odom_base.linear() =
        Eigen::AngleAxisd(share * yaw_deg * M_PI / 180, Eigen::Vector3d::UnitZ()) *
        odometry[i].T_odom_base.linear();
  }
  return odometry;
}

/// @param exchanged_share  of the points, which look like others after the blind stretch
/// @param elsewhere        so many frames after the blind stretch show another room
FlightRun flyBlindly(std::uint64_t seed, double yaw_deg, double exchanged_share,
                     std::size_t elsewhere = 0) {
  const Flight flight = flightWithABlindStretch();
  PointWorld world(seed);
  world.addRoom({10, 8, 3}, 1200);
  PointWorld other_world(seed + 1000);
  other_world.addRoom({10, 8, 3}, 1200);
  std::vector<ImageFeatures> frames;
  for (std::size_t i = 0; i < flight.size(); ++i) {
    const bool is_blind = i >= kSeen && i < kAgainFrom;
    const bool is_elsewhere = i >= kAgainFrom && i < kAgainFrom + elsewhere;
    if (i == kAgainFrom) world.exchangeDescriptors(exchanged_share);
    const Eigen::Isometry3d T_map_cam = flight[i].T_map_base * test::forwardExtrinsics();
    frames.push_back(
        is_blind ? world.emptyView(flight[i].stamp_ns)
                 : (is_elsewhere ? other_world : world).look(T_map_cam, flight[i].stamp_ns));
    if (!is_elsewhere) continue;
    for (auto& track_id : frames.back().track_id) track_id += 1000000;  // the worlds count alike
  }
  return test::run(frames, observeDrifting(flight, seed, yaw_deg), test::msckfConfig());
}

double error_m(const FlightRun& run, std::size_t frame) {
  const Flight flight = flightWithABlindStretch();
  return (run.results[frame].T_map_base.translation() - flight[frame].T_map_base.translation())
      .norm();
}

TEST(RelocationWorld, TheFirstImageAfterABlindStretchFindsThePlaceAgain) {
  std::vector<double> errors_m;
  for (const double wrong_share : {0.0, 0.5}) {
    for (const double yaw_deg : {0.0, 3.0}) {
      for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        const FlightRun run = flyBlindly(seed, yaw_deg, wrong_share);
        ASSERT_GT(error_m(run, kAgainFrom - 1), 1.3);
        EXPECT_EQ(run.results[kAgainFrom].state, SlamState::kRelocated)
            << wrong_share << ", " << yaw_deg << " degrees, seed " << seed;
        errors_m.push_back(error_m(run, kAgainFrom));
        for (std::size_t i = kAgainFrom; i < kAgainFrom + 30; ++i)
          EXPECT_LT(error_m(run, i), 0.38) << wrong_share << ", " << yaw_deg << " degrees, seed "
                                           << seed << ", frame " << i;  // measured: 0.25
      }
    }
  }
  // Measured: 0.07. While the room is seen for the first time the error grows to 0.12 to 0.24.
  std::nth_element(errors_m.begin(), errors_m.begin() + 16, errors_m.end());
  EXPECT_LT(errors_m[16], 0.11);
}

TEST(RelocationWorld, NorDoFourWrongMatchesOfFivePreventIt) {
  int at_once = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const FlightRun run = flyBlindly(seed, 3, 0.8);
    at_once += run.results[kAgainFrom].state == SlamState::kRelocated ? 1 : 0;
    EXPECT_LT(error_m(run, kAgainFrom + 30), 0.18) << "seed " << seed;  // measured: 0.12
  }
  EXPECT_GE(at_once, 6);  // measured: 7
}

TEST(RelocationWorld, AMapBegunAnewMeanwhileDoesNotPreventItEither) {
  constexpr std::size_t kElsewhere = 100;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const FlightRun run = flyBlindly(seed, 2, 0, kElsewhere);
    constexpr std::size_t kHome = kAgainFrom + kElsewhere;
    EXPECT_GT(error_m(run, kHome - 1), 1.3) << "seed " << seed;
    EXPECT_EQ(run.results[kHome].state, SlamState::kRelocated) << "seed " << seed;
    EXPECT_LT(error_m(run, kHome + 30), 0.32) << "seed " << seed;  // measured: 0.04 to 0.21
  }
}

TEST(RelocationWorld, APlaceThatOnlyLooksAlikeIsNotTakenForOneSeenBefore) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const FlightRun run = flyBlindly(seed, 2, 1);
    EXPECT_EQ(test::framesIn(run, SlamState::kRelocated, kAgainFrom), 0) << "seed " << seed;
    EXPECT_LT(std::abs(error_m(run, run.results.size() - 1) - error_m(run, kAgainFrom - 1)), 0.5)
        << "seed " << seed;
  }
}

/// Laps of the room; from the second one on the frames are changed by somebody.
class FailingLandmarks : public ::testing::Test {
 protected:
  static constexpr std::size_t kLap = 200;

  FailingLandmarks() : flight_(test::lapsFlight(kLap, 4, kRelocationRate_hz)), world_(1) {
    world_.addRoom({10, 8, 3}, 1200);
  }
  ImageFeatures look(std::size_t frame) {
    return world_.look(flight_[frame].T_map_base * test::forwardExtrinsics(),
                       flight_[frame].stamp_ns);
  }
  FlightRun flyThrough() const {
    return test::run(frames_, test::observe(flight_, {}, 1), config_);
  }
  static int removedOf(const FlightRun& run) {
    int removed = 0;
    for (const FrameResult& result : run.results) removed += result.removed_landmarks;
    return removed;
  }
  int lostOf(const FlightRun& run) const {  // not seen in the last two laps
    const std::int64_t since_ns = flight_[2 * kLap].stamp_ns;
    return static_cast<int>(
        std::count_if(run.landmarks.begin(), run.landmarks.end(),
                      [&](const Landmark& one) { return one.last_seen_ns < since_ns; }));
  }

  Flight flight_;
  PointWorld world_;
  std::vector<ImageFeatures> frames_;
  SlamConfig config_ = test::msckfConfig();
};

TEST_F(FailingLandmarks, WhatIsNoLongerThereIsDropped) {
  for (std::size_t i = 0; i < flight_.size(); ++i) {
    if (i == kLap) world_.exchangeDescriptors(0.3);
    frames_.push_back(look(i));
  }
  const FlightRun run = flyThrough();
  config_.mapper.drop_failing_ratio = 1e6;
  const FlightRun kept = flyThrough();
  EXPECT_GT(removedOf(run), 80);  // measured: 117
  EXPECT_EQ(removedOf(kept), 0);
  EXPECT_LT(lostOf(run), lostOf(kept) / 2);  // measured: 53 of 170
}

TEST_F(FailingLandmarks, WhatIsHiddenForAWhileStays) {
  for (std::size_t i = 0; i < flight_.size(); ++i) {
    ImageFeatures all = look(i);
    const bool is_hidden = i >= kLap && i < kLap + 50;
    ImageFeatures seen = world_.emptyView(all.stamp_ns);
    for (std::size_t f = 0; f < all.size(); ++f) {
      if (is_hidden && all.pixel_px[f].x() < 0.4F * static_cast<float>(all.width_px)) continue;
      seen.pixel_px.push_back(all.pixel_px[f]);
      seen.bearing_cam.push_back(all.bearing_cam[f]);
      seen.score.push_back(all.score[f]);
      seen.descriptor.push_back(all.descriptor[f]);
      seen.track_id.push_back(all.track_id[f]);
      seen.age_frames.push_back(all.age_frames[f]);
    }
    frames_.push_back(std::move(seen));
  }
  EXPECT_EQ(removedOf(flyThrough()), 0);
}

TEST_F(FailingLandmarks, BehindAWallNoneFails) {
  PointWorld elsewhere(2);
  elsewhere.addRoom({10, 8, 3}, 1200);
  for (std::size_t i = 0; i < flight_.size(); ++i) {
    const bool is_behind = i >= kLap && i < 2 * kLap;
    frames_.push_back(is_behind ? elsewhere.look(flight_[i].T_map_base * test::forwardExtrinsics(),
                                                 flight_[i].stamp_ns)
                                : look(i));
    if (!is_behind) continue;
    for (auto& track_id : frames_.back().track_id) track_id += 1000000;
  }
  EXPECT_EQ(removedOf(flyThrough()), 0);
}

}  // namespace
}  // namespace ardrone_vslam
