// SPDX-License-Identifier: BSD-3-Clause
// Offsets of the images' stamps that are found and used while flying.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ardrone_vslam/setup_monitor.hpp"
#include "support/turning_camera.hpp"

namespace ardrone_vslam {
namespace {

using test::PointCamera;
using test::Swaying;

constexpr double kRate_hz = 30;
constexpr double kDuration_s = 20;
const NumberOrAuto kFound;

struct Filmed {
  int changes = 0;
  double used_s = 0;
  double slowest_pace = 1;  ///< of the exposures, of the stamps'
};

/// A flight whose images are stamped early by the offset.
Filmed film(ImageClock& clock, double offset_s, std::uint64_t seed,
            SetupFault fault = SetupFault::kNone) {
  const Swaying flight(seed);
  const auto odometry = test::swayOdometry(flight, kDuration_s, 200, {0.001, 0}, seed);
  PointCamera camera(seed);
  clock.useCamera(test::forwardExtrinsics());
  Filmed filmed;
  std::int64_t exposed_ns = 0;
  std::int64_t stamp_ns = 0;
  for (double t_s = 0; t_s < kDuration_s; t_s += 1 / kRate_hz) {
    const ImageFeatures image =
        camera.look(flight.T_map_base(t_s), test::swayStamp_ns(t_s - offset_s));
    const std::int64_t next_ns = clock.exposed_ns(image.stamp_ns);
    if (stamp_ns != 0) {
      const double pace = static_cast<double>(next_ns - exposed_ns) /
                          static_cast<double>(image.stamp_ns - stamp_ns);
      filmed.slowest_pace = std::min(filmed.slowest_pace, pace);
    }
    exposed_ns = next_ns;
    stamp_ns = image.stamp_ns;
    if (clock.see(image, odometry, fault) != 0) ++filmed.changes;
  }
  EXPECT_NEAR(static_cast<double>(exposed_ns - stamp_ns) * 1e-9, clock.used_s(), 1e-9)
      << "the offset in use is that of the last exposure";
  filmed.used_s = clock.used_s();
  return filmed;
}

TEST(ImageClock, FindsTheOffsetByItself) {
  for (const double offset_s : {-0.15, -0.06, 0.06, 0.15}) {
    ImageClock clock(kFound);
    const Filmed filmed = film(clock, offset_s, 3);
    EXPECT_GE(filmed.changes, 1) << offset_s;
    EXPECT_NEAR(filmed.used_s, offset_s, 0.015) << "it goes on from steps of more than that";
  }
}

TEST(ImageClock, ExposuresAscendWithTheStamps) {
  ImageClock clock(kFound);
  const Filmed filmed = film(clock, -0.15, 4);
  ASSERT_GE(filmed.changes, 1);
  EXPECT_NEAR(filmed.slowest_pace, 0.1, 1e-6);
}

TEST(ImageClock, LeavesStampsThatAreRight) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    ImageClock clock(kFound);
    EXPECT_EQ(film(clock, 0, seed).changes, 0) << "seed " << seed;
    EXPECT_EQ(clock.used_s(), 0);
  }
}

TEST(ImageClock, WhatIsToldStays) {
  ImageClock clock(-0.05);
  const Filmed filmed = film(clock, 0.1, 3);
  EXPECT_EQ(filmed.changes, 0);
  EXPECT_EQ(filmed.used_s, -0.05);
  EXPECT_EQ(clock.estimate().state, TimeOffsetState::kKnown) << "for the advice";
}

TEST(ImageClock, AFaultOfTheSetUpTeachesNothing) {
  ImageClock turned(kFound);
  EXPECT_EQ(film(turned, 0.1, 3, SetupFault::kExtrinsics).changes, 0);
  ImageClock late(kFound);
  EXPECT_GE(film(late, 0.1, 3, SetupFault::kTimeOffset).changes, 1);
}

TEST(ImageClock, IsKeptByTheNextCameraAndWhenStampsGoBack) {
  ImageClock clock(kFound);
  film(clock, 0.1, 3);
  const double found_s = clock.used_s();
  clock.useCamera(test::forwardExtrinsics());
  EXPECT_EQ(clock.used_s(), found_s);
  const std::int64_t earlier_ns = test::swayStamp_ns(0);
  EXPECT_EQ(clock.exposed_ns(earlier_ns), earlier_ns + std::llround(found_s * 1e9));
}

}  // namespace
}  // namespace ardrone_vslam
