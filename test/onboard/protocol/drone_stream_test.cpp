// SPDX-License-Identifier: BSD-3-Clause
#include "protocol/drone_stream.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>

#include "onboard/telemetry_flight.hpp"

namespace ardrone_vslam::test {
namespace {

constexpr std::int64_t kFramePeriod_ns = 33'333'333;

VslamPose somePose(std::uint32_t sequence) {
  VslamPose pose{};
  pose.sequence = sequence;
  pose.flags = VSLAM_POSE_IS_VALID;
  pose.state = VSLAM_TRACKING;
  pose.stamp_ns = sequence * kFramePeriod_ns;
  pose.position_m[0] = 0.25 * sequence;
  pose.quaternion[3] = pose.observer_quaternion[0] = 1;
  return pose;
}

Bytes bytesOf(const VslamPose& pose) {
  Bytes bytes(VSLAM_POSE_BYTES);
  vslam_write_pose(&pose, bytes.data());
  return bytes;
}

class DroneStreamTest : public ::testing::Test {
 protected:
  using Read = DroneStream::Read;

  Read read(const Bytes& bytes) {
    return stream_.read(bytes.data(), bytes.size(), now_ns_ += 1000);
  }
  Read read(const VslamPose& pose) { return read(bytesOf(pose)); }
  std::uint64_t count(DatagramFault fault) const { return stream_.counts().of(fault); }

  DroneStream stream_;
  std::int64_t now_ns_ = 1'000'000'000'000;
};

TEST_F(DroneStreamTest, PosesAndTelemetryComeThrough) {
  TelemetryFlight flight(1);
  flight.grow(20);
  EXPECT_EQ(read(somePose(1)), Read::kPose);
  EXPECT_EQ(stream_.pose().position_m[0], 0.25);
  EXPECT_EQ(read(flight.next(10)), Read::kTelemetry);
  EXPECT_EQ(stream_.telemetry().size(), 20U);
  EXPECT_EQ(stream_.telemetry().features().size(), 10U);
  EXPECT_EQ(stream_.counts().poses + stream_.counts().telemetry, 2U);
  EXPECT_EQ(stream_.counts().bad() + stream_.counts().restarts + stream_.posesLost(), 0U);
}

TEST_F(DroneStreamTest, EveryDamageIsCountedAndNothingOfItUsed) {
  TelemetryFlight flight(2);
  flight.grow(20);
  ASSERT_EQ(read(somePose(1)), Read::kPose);
  ASSERT_EQ(read(flight.next(10)), Read::kTelemetry);
  std::uint64_t bad = 0;
  for (const Bytes& good : {bytesOf(somePose(2)), flight.next(30)}) {
    for (int trial = 0; trial < 2000; ++trial) {
      Bytes datagram = good;
      if (trial % 4 == 0) {
        datagram.resize(flight.random() % good.size());
      } else {
        const std::size_t bit = flight.random() % (8 * good.size());
        datagram[bit / 8] = static_cast<std::uint8_t>(datagram[bit / 8] ^ (1U << bit % 8));
      }
      EXPECT_EQ(read(datagram), Read::kNothing);
      EXPECT_EQ(stream_.counts().bad(), ++bad);
      EXPECT_NE(std::string(explain(stream_.fault())), "");
    }
  }
  EXPECT_EQ(stream_.pose().sequence, 1U);
  EXPECT_EQ(stream_.telemetry().features().size(), 10U);
  for (const DatagramFault fault :
       {DatagramFault::kForeign, DatagramFault::kVersion, DatagramFault::kKind,
        DatagramFault::kSize, DatagramFault::kCorrupted})
    EXPECT_GT(count(fault), 0U) << explain(fault);
  EXPECT_EQ(stream_.posesLost() + stream_.telemetryLost(), 0U) << "a damaged number was believed";
}

TEST_F(DroneStreamTest, NumbersThatCannotBeAreRefused) {
  const auto refuses = [this](const std::function<void(VslamPose&)>& change) {
    VslamPose pose = somePose(5);
    change(pose);
    return read(pose) == Read::kNothing && stream_.fault() == DatagramFault::kRefused;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(refuses([&](VslamPose& p) { p.position_m[2] = nan; }));
  EXPECT_TRUE(refuses([&](VslamPose& p) { p.quaternion[3] = 1.1; }));
  EXPECT_TRUE(refuses([&](VslamPose& p) { p.quaternion[0] = nan; }));
  EXPECT_TRUE(refuses([&](VslamPose& p) { p.observer_quaternion[0] = 0; }));
  EXPECT_TRUE(refuses([&](VslamPose& p) { p.deviation[5] = -1; }));
  EXPECT_TRUE(refuses([&](VslamPose& p) { p.state = VSLAM_ENDING; }));
  EXPECT_TRUE(refuses([&](VslamPose& p) { p.state = VSLAM_NOT_FINITE; }));
  EXPECT_TRUE(refuses([&](VslamPose& p) {
    p.state = VSLAM_LAST_STATE + 1;
    p.flags = 0;
  }));
  EXPECT_TRUE(refuses([&](VslamPose& p) { p.stamp_ns = 0; }));
  EXPECT_EQ(count(DatagramFault::kRefused), 9U);
  EXPECT_EQ(read(somePose(5)), Read::kPose);
}

TEST_F(DroneStreamTest, LostAndOvertakenOnesAreCounted) {
  for (const std::uint32_t sequence : {1U, 2U, 5U})
    EXPECT_EQ(read(somePose(sequence)), Read::kPose);
  EXPECT_EQ(stream_.posesLost(), 2U);
  for (const std::uint32_t sequence : {4U, 5U}) EXPECT_EQ(read(somePose(sequence)), Read::kNothing);
  EXPECT_EQ(count(DatagramFault::kLate), 2U);
  EXPECT_EQ(stream_.counts().bad(), 0U);
  EXPECT_EQ(stream_.pose().sequence, 5U);
  EXPECT_EQ(read(somePose(6)), Read::kPose);

  TelemetryFlight flight(3);
  flight.grow(5);
  const Bytes first = flight.next(1);
  const Bytes second = flight.next(2);
  const Bytes third = flight.next(3);
  EXPECT_EQ(read(first), Read::kTelemetry);
  EXPECT_EQ(read(third), Read::kTelemetry);
  EXPECT_EQ(read(second), Read::kNothing);
  EXPECT_EQ(stream_.telemetryLost(), 1U);
  EXPECT_EQ(stream_.telemetry().features().size(), 3U);
}

TEST_F(DroneStreamTest, NumbersMayWrapAround) {
  VslamPose pose = somePose(10);
  pose.sequence = 0xFFFFFFFFU;
  EXPECT_EQ(read(pose), Read::kPose);
  pose = somePose(11);
  pose.sequence = 1;
  EXPECT_EQ(read(pose), Read::kPose);
  EXPECT_EQ(stream_.posesLost(), 1U);
  EXPECT_EQ(stream_.counts().restarts, 0U);
}

TEST_F(DroneStreamTest, AProgramThatIsStartedAgainIsFollowed) {
  TelemetryFlight flight(4);
  flight.grow(30);
  ASSERT_EQ(read(somePose(1000)), Read::kPose);
  for (int i = 0; i < 200; ++i) ASSERT_EQ(read(flight.next(1)), Read::kTelemetry);
  // At once, though it stamps on by the same clock.
  VslamPose pose = somePose(1001);
  pose.sequence = 1;
  EXPECT_EQ(read(pose), Read::kPose);
  EXPECT_EQ(stream_.counts().restarts, 1U);
  EXPECT_EQ(stream_.telemetry().size(), 0U) << "the map of the program before";
  TelemetryFlight again(5);
  again.grow(3);
  EXPECT_EQ(read(again.next(1)), Read::kTelemetry);
  EXPECT_EQ(stream_.telemetry().size(), 3U);

  // One that had hardly begun: its numbers count as late for a second.
  pose = somePose(2);
  pose.sequence = 1;
  EXPECT_EQ(read(pose), Read::kNothing);
  now_ns_ += SequenceGuard::kForget_ns;
  EXPECT_EQ(read(pose), Read::kPose);
  EXPECT_EQ(stream_.counts().restarts, 2U);
  EXPECT_EQ(stream_.posesLost() + stream_.telemetryLost(), 0U);
}

TEST_F(DroneStreamTest, AClockThatIsSetBackIsARestartAndASmallStepIsRefused) {
  ASSERT_EQ(read(somePose(100)), Read::kPose);
  VslamPose pose = somePose(101);
  pose.stamp_ns = somePose(100).stamp_ns;
  EXPECT_EQ(read(pose), Read::kNothing);
  EXPECT_EQ(count(DatagramFault::kRefused), 1U);
  pose = somePose(102);
  pose.stamp_ns -= 2'000'000'000;
  EXPECT_EQ(read(pose), Read::kPose);
  EXPECT_EQ(stream_.counts().restarts, 1U);
}

TEST_F(DroneStreamTest, AMapThatBeganAnewIsForgotten) {
  TelemetryFlight flight(6);
  flight.grow(10);
  std::uint32_t sequence = 0;
  for (const int state : {VSLAM_NOT_FINITE, VSLAM_OUT_OF_MEMORY}) {
    ASSERT_EQ(read(flight.next(1)), Read::kTelemetry);
    EXPECT_EQ(stream_.telemetry().size(), 10U);
    VslamPose pose = somePose(++sequence);
    pose.flags = 0;
    pose.state = static_cast<std::uint32_t>(state);
    EXPECT_EQ(read(pose), Read::kPose);
    EXPECT_EQ(stream_.telemetry().size(), 0U);
  }
}

TEST_F(DroneStreamTest, AnswersWithoutAPoseNeedNoStamp) {
  ASSERT_EQ(read(somePose(100)), Read::kPose);
  VslamPose pose{};
  pose.sequence = 101;
  pose.state = VSLAM_CONTROLLER_SILENT;
  EXPECT_EQ(read(pose), Read::kPose);
  EXPECT_EQ(stream_.counts().restarts, 0U);
  EXPECT_EQ(stream_.pose().state, 0U + VSLAM_CONTROLLER_SILENT);
}

}  // namespace
}  // namespace ardrone_vslam::test
