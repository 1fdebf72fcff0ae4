// SPDX-License-Identifier: BSD-3-Clause
// Stamps and track ids beyond the limits that narrower numbers have: the flight stays the same.
#include <gtest/gtest.h>

#include <limits>

#include "support/point_flight.hpp"

namespace ardrone_vslam {
namespace {

using test::Flight;
using test::FlightRun;

class WrapWorld : public ::testing::Test {
 protected:
  WrapWorld()
      : flight_(test::lapsFlight(kLapFrames, 2, 10)), odometry_(test::observe(flight_, {}, 2)) {
    PointWorld world = test::pointRoom(2);
    frames_ = test::film(world, flight_);
  }

  static constexpr int kLapFrames = 100;
  Flight flight_;
  std::vector<OdometryState> odometry_;
  std::vector<ImageFeatures> frames_;
};

TEST_F(WrapWorld, TheFlightIsTheSameAtAnyTime) {
  const FlightRun now = test::run(frames_, odometry_, {});
  const auto wrap_s = [](int bits) { return static_cast<double>(std::uint64_t{1} << bits); };
  // 2038, when 31 bits of seconds end, 2106, when the 32 of ROS do, and just before 63 bits of
  // nanoseconds end: halfway through the flight, but for the last.
  const double first_half_s = 0.1 * kLapFrames;
  for (const double middle_s : {wrap_s(31), wrap_s(32), 9223372024.0}) {
    SCOPED_TRACE(middle_s);
    const auto shift_ns = static_cast<std::int64_t>(middle_s - first_half_s) * 1'000'000'000;
    auto frames = frames_;
    auto odometry = odometry_;
    for (ImageFeatures& frame : frames) frame.stamp_ns += shift_ns;
    for (OdometryState& state : odometry) state.stamp_ns += shift_ns;
    const FlightRun then = test::run(frames, odometry, {});
    ASSERT_EQ(then.landmarks.size(), now.landmarks.size());
    for (std::size_t i = 0; i < now.results.size(); ++i) {
      ASSERT_EQ(then.results[i].stamp_ns, now.results[i].stamp_ns + shift_ns);
      ASSERT_EQ(then.results[i].T_map_base.matrix(), now.results[i].T_map_base.matrix()) << i;
      ASSERT_EQ(then.results[i].covariance, now.results[i].covariance) << i;
    }
  }
}

TEST_F(WrapWorld, TrackIdsComeRound) {
  const FlightRun before = test::run(frames_, odometry_, {});
  const std::uint32_t middle = frames_[kLapFrames].track_id.back();
  const std::uint32_t shift = std::numeric_limits<std::uint32_t>::max() - middle;
  auto frames = frames_;
  std::uint32_t smallest = shift;
  for (ImageFeatures& frame : frames) {
    for (std::uint32_t& id : frame.track_id) {
      id = id > middle ? id - middle : id + shift;  // as FrameTracker does: 0 is left out
      smallest = std::min(smallest, id);
    }
  }
  ASSERT_EQ(smallest, 1U) << "the ids do not come round";
  const FlightRun after = test::run(frames, odometry_, {});
  // Tracks are used in the order of their ids, so sums are rounded otherwise.
  for (std::size_t i = 0; i < before.results.size(); ++i) {
    const Eigen::Vector3d apart_m =
        after.results[i].T_map_base.translation() - before.results[i].T_map_base.translation();
    ASSERT_LT(apart_m.norm(), 0.01) << i;
    ASSERT_EQ(after.results[i].state, before.results[i].state) << i;
  }
}

}  // namespace
}  // namespace ardrone_vslam
