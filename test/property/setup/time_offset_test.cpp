// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/time_offset.hpp"

#include <gtest/gtest.h>

#include "support/turning_camera.hpp"

namespace ardrone_vslam {
namespace {

using test::AttitudeErrors;
using test::PointCamera;
using test::Swaying;

constexpr double kOffsetRate_hz = 30;

/// Images of a flight, their stamps early by the offset. @param after  called with the seconds
/// since the first one, after each image
template <class Flight, class After>
void film(TimeOffsetEstimator& estimator, const Flight& flight, const OdometryBuffer& odometry,
          double offset_s, double duration_s, std::uint64_t seed, const After& after) {
  PointCamera camera(seed);
  for (double t_s = 0; t_s < duration_s; t_s += 1 / kOffsetRate_hz) {
    estimator.see(camera.look(flight.T_map_base(t_s), test::swayStamp_ns(t_s - offset_s)),
                  odometry);
    after(t_s);
  }
}

TEST(TimeOffset, IsFoundWithinTwentySecondsWhateverItIs) {
  RandomSource random(8);
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    const Swaying flight(seed);
    const double offset_s = random.uniform(-0.05, 0.15);
    const AttitudeErrors errors{random.uniform(0, 0.003), random.uniform(-0.005, 0.005)};
    const double odometry_hz = seed % 3 == 0 ? 30 : seed % 3 == 1 ? 50 : 200;
    const auto odometry = test::swayOdometry(flight, 20, odometry_hz, errors, seed);
    TimeOffsetEstimator estimator(test::forwardExtrinsics());
    film(estimator, flight, odometry, offset_s, 20, seed, [&](double t_s) {
      const TimeOffset& found = estimator.estimate();
      if (found.state != TimeOffsetState::kKnown) return;
      // Once it is told it must hold.
      ASSERT_LT(std::abs(found.offset_s - offset_s), 5 * found.sigma_s)
          << "seed " << seed << " at " << t_s << " s";
    });
    const TimeOffset& found = estimator.estimate();
    ASSERT_EQ(found.state, TimeOffsetState::kKnown) << "seed " << seed;
    EXPECT_NEAR(found.offset_s, offset_s, 0.006) << "seed " << seed;
    EXPECT_LE(found.sigma_s, TimeOffsetEstimator::kSure_s);
  }
}

TEST(TimeOffset, LiesAboutTheCentre) {
  const Swaying flight(3);
  const auto odometry = test::swayOdometry(flight, 20, 200, {0.001, 0}, 3);
  TimeOffsetEstimator about(test::forwardExtrinsics(), -0.4);
  film(about, flight, odometry, -0.35, 20, 3, [](double) {});
  ASSERT_EQ(about.estimate().state, TimeOffsetState::kKnown);
  EXPECT_NEAR(about.estimate().offset_s, -0.35, 0.006);
  TimeOffsetEstimator beside(test::forwardExtrinsics());
  film(beside, flight, odometry, -0.35, 20, 3, [](double) {});
  EXPECT_NE(beside.estimate().state, TimeOffsetState::kKnown);
}

/// Turns evenly, as well as not at all: no offset can be told.
struct Even {
  double rate_rad_s;
  Eigen::Isometry3d T_map_base(double t_s) const {
    return Eigen::Isometry3d(Eigen::AngleAxisd(rate_rad_s * t_s, Eigen::Vector3d::UnitZ()));
  }
};

TEST(TimeOffset, IsNotKnownWithoutTurningToAndFro) {
  for (const double rate_rad_s : {0.0, 0.5}) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      const Even flight{rate_rad_s};
      const auto odometry = test::swayOdometry(flight, 30, 200, {0.002, 0.003}, seed);
      TimeOffsetEstimator estimator(test::forwardExtrinsics());
      film(estimator, flight, odometry, 0.04, 30, seed, [&](double t_s) {
        ASSERT_NE(estimator.estimate().state, TimeOffsetState::kKnown) << seed << " at " << t_s;
      });
      EXPECT_EQ(estimator.estimate().state, TimeOffsetState::kTooLittleRotation);
    }
  }
}

/// A flight as odometry has it whose heading jumps, as when a driver starts anew.
struct Jumping {
  const Swaying& flight;
  double jumps_s;
  double by_rad;
  Eigen::Isometry3d T_map_base(double t_s) const {
    const Eigen::AngleAxisd heading(t_s < jumps_s ? 0 : by_rad, Eigen::Vector3d::UnitZ());
    return heading * flight.T_map_base(t_s);
  }
};

TEST(TimeOffset, IsNotToldByAHeadingThatJumps) {
  for (const double rotations_rad : {0.0, 0.02, 0.15}) {
    const Swaying flight(3, rotations_rad);
    for (const double jumps_s : {0.5, 1.0, 2.0, 5.0, 10.0}) {
      for (const double by_rad : {0.1, 0.3, 2.0}) {
        const Jumping jumping{flight, jumps_s, by_rad};
        const auto odometry = test::swayOdometry(jumping, 20, 200, {0.001, 0}, 3);
        TimeOffsetEstimator estimator(test::forwardExtrinsics());
        film(estimator, flight, odometry, 0, 20, 3, [&](double t_s) {
          const TimeOffset& found = estimator.estimate();
          if (found.state != TimeOffsetState::kKnown) return;
          ASSERT_NEAR(found.offset_s, 0, 0.015)
              << "turns " << rotations_rad << ", jump of " << by_rad << " at " << jumps_s
              << " s, at " << t_s << " s";
        });
      }
    }
  }
}

TEST(TimeOffset, AWrongMountingIsADisagreement) {
  const Swaying flight(2);
  const auto odometry = test::swayOdometry(flight, 20, 200, {0.001, 0}, 2);
  Eigen::Isometry3d T_base_cam = test::forwardExtrinsics();
  T_base_cam.rotate(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitZ()));  // upside down
  TimeOffsetEstimator estimator(T_base_cam);
  film(estimator, flight, odometry, 0.04, 20, 2,
       [&](double) { ASSERT_NE(estimator.estimate().state, TimeOffsetState::kKnown); });
  EXPECT_EQ(estimator.estimate().state, TimeOffsetState::kDisagreement);
}

TEST(TimeOffset, ImagesWithoutOdometryOrTracksAreLeftOut) {
  const Swaying flight(4);
  TimeOffsetEstimator blind(test::forwardExtrinsics());
  film(blind, flight, OdometryBuffer({}), 0, 5, 4, [](double) {});
  EXPECT_EQ(blind.estimate().state, TimeOffsetState::kTooFewImages);
  ImageFeatures empty;
  empty.focal_length_px = 570;
  const auto odometry = test::swayOdometry(flight, 5, 200, {}, 4);
  for (int i = 0; i < 100; ++i) {
    empty.stamp_ns = test::swayStamp_ns(0.05 * i);
    blind.see(empty, odometry);
  }
  EXPECT_EQ(blind.estimate().state, TimeOffsetState::kTooFewImages);
}

TEST(TimeOffset, IsKeptWhenTimeBeginsAgain) {
  const Swaying flight(5);
  const auto odometry = test::swayOdometry(flight, 20, 200, {0.001, 0}, 5);
  TimeOffsetEstimator estimator(test::forwardExtrinsics());
  film(estimator, flight, odometry, 0.1, 20, 5, [](double) {});
  const double found_s = estimator.estimate().offset_s;
  ASSERT_EQ(estimator.estimate().state, TimeOffsetState::kKnown);
  film(estimator, flight, odometry, 0.1, 20, 6, [&](double) {
    ASSERT_EQ(estimator.estimate().state, TimeOffsetState::kKnown);
    ASSERT_NEAR(estimator.estimate().offset_s, found_s, 0.006);
  });
}

TEST(TimeOffset, AdviceNeedsAClearDifference) {
  const TimeOffset found{TimeOffsetState::kKnown, -0.08, 0.003};
  EXPECT_NE(adviceOn(found, 0.0, 0).find("set image_time_offset_s: -0.080"), std::string::npos);
  EXPECT_EQ(adviceOn(found, -0.07, -0.07), "");  // less than 15 ms
  EXPECT_EQ(adviceOn({TimeOffsetState::kKnown, -0.08, 0.03}, 0.0, 0), "");
  EXPECT_EQ(adviceOn({TimeOffsetState::kTooLittleRotation, 0, 0}, 1.0, 1), "");
}

TEST(TimeOffset, WhatIsUsedByItselfIsSaid) {
  const TimeOffset found{TimeOffsetState::kKnown, -0.081, 0.003};
  EXPECT_EQ(adviceOn(found, {}, 0), "") << "not in use yet";
  EXPECT_NE(adviceOn(found, {}, -0.08).find("with image_time_offset_s: -0.080"), std::string::npos);
  EXPECT_NE(adviceOn({}, {}, -0.08).find("with image_time_offset_s: -0.080"), std::string::npos)
      << "told of what is in use although nothing is known at last";
}

TEST(TimeOffset, FollowsAChange) {
  const Swaying flight(7);
  const auto odometry = test::swayOdometry(flight, 90, 200, {0.001, 0}, 7);
  TimeOffsetEstimator estimator(test::forwardExtrinsics());
  PointCamera camera(7);
  for (double t_s = 0; t_s < 90; t_s += 1 / kOffsetRate_hz) {
    const double offset_s = t_s < 30 ? 0.02 : 0.08;
    estimator.see(camera.look(flight.T_map_base(t_s), test::swayStamp_ns(t_s - offset_s)),
                  odometry);
  }
  EXPECT_NEAR(estimator.estimate().offset_s, 0.08, 0.015);
}

}  // namespace
}  // namespace ardrone_vslam
