// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "onboard/flight_records.hpp"
#include "protocol/vslam_protocol.h"

namespace ardrone_vslam::test {
namespace {

VslamObserver someOdometry() {
  VslamObserver o = odometryAt(1234567890123456789, 0xFFFFFFF0U);
  o.flags = VSLAM_OBSERVER_HAS_VARIANCE | VSLAM_OBSERVER_HAS_HEIGHT;
  const double position[] = {1.5, -2.25, 1e-300};
  const double quaternion[] = {0.5, -0.5, 0.5, -0.5};
  std::memcpy(o.position_m, position, sizeof position);
  std::memcpy(o.quaternion, quaternion, sizeof quaternion);
  for (int i = 0; i < 6; ++i) o.variance[i] = 0.1 * (i + 1);
  o.height_m = 0.75;
  return o;
}

TEST(Protocol, TheChecksumIsZlibs) {
  const std::string text = "123456789";
  EXPECT_EQ(vslam_crc32(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()),
            0xCBF43926U);
}

TEST(Protocol, ObserverComesBackAsItWas) {
  const VslamObserver sent = someOdometry();
  const Record record = recordOf(sent);
  VslamObserver got{};
  ASSERT_EQ(vslam_read_observer(record.data(), record.size(), &got), VSLAM_GOOD);
  EXPECT_EQ(got.sequence, sent.sequence);
  EXPECT_EQ(got.flags, sent.flags);
  EXPECT_EQ(got.stamp_ns, sent.stamp_ns);
  EXPECT_TRUE(std::equal(std::begin(got.position_m), std::end(got.position_m), sent.position_m));
  EXPECT_TRUE(std::equal(std::begin(got.quaternion), std::end(got.quaternion), sent.quaternion));
  EXPECT_TRUE(std::equal(std::begin(got.variance), std::end(got.variance), sent.variance));
  EXPECT_EQ(got.height_m, sent.height_m);
}

TEST(Protocol, PoseComesBackAsItWas) {
  VslamPose sent{};
  sent.sequence = 7;
  sent.flags = VSLAM_POSE_IS_VALID;
  sent.state = VSLAM_RELOCATED;
  sent.stamp_ns = -5;
  for (int i = 0; i < 6; ++i) sent.deviation[i] = i + 0.5;
  for (int i = 0; i < 3; ++i) sent.position_m[i] = sent.observer_position_m[i] = 3.0 - i;
  for (int i = 0; i < 4; ++i) sent.quaternion[i] = sent.observer_quaternion[i] = 0.5;
  sent.frames_dropped = 1;
  sent.records_dropped = 0xFFFFFFFFU;
  sent.landmarks = 5000;
  std::array<std::uint8_t, VSLAM_POSE_BYTES> record;
  vslam_write_pose(&sent, record.data());
  VslamPose got{};
  ASSERT_EQ(vslam_read_pose(record.data(), record.size(), &got), VSLAM_GOOD);
  std::array<std::uint8_t, VSLAM_POSE_BYTES> again;
  vslam_write_pose(&got, again.data());
  EXPECT_EQ(record, again);
  EXPECT_EQ(got.state, sent.state);
  EXPECT_EQ(got.stamp_ns, -5);
  EXPECT_EQ(got.records_dropped, 0xFFFFFFFFU);
  EXPECT_EQ(got.landmarks, 5000U);
  EXPECT_EQ(got.observer_quaternion[3], 0.5);
}

/// Other programs, perhaps in other languages, have these places.
TEST(Protocol, FieldsAreWhereTheyAreDocumented) {
  const Record record = recordOf(someOdometry());
  EXPECT_EQ(std::string(record.begin(), record.begin() + 4), "VSLM");
  EXPECT_EQ(record[4], 1);  // version
  EXPECT_EQ(record[5], 1);  // kind
  EXPECT_EQ(record[6] | record[7] << 8, VSLAM_OBSERVER_BYTES);
  EXPECT_EQ(record[8], 0xF0);  // sequence
  EXPECT_EQ(record[12], 3);    // flags
  EXPECT_EQ(record[16], 1234567890123456789 & 255);
  EXPECT_EQ(record[24 + 6] | record[24 + 7] << 8, 0x3FF8);  // 1.5
}

TEST(Protocol, EveryBitThatFlipsAndEveryOtherSizeIsSeen) {
  const Record good = recordOf(someOdometry());
  VslamObserver observer = odometryAt(42, 42);
  for (std::size_t bit = 0; bit < 8 * good.size(); ++bit) {
    Record record = good;
    record[bit / 8] = static_cast<std::uint8_t>(record[bit / 8] ^ (1U << bit % 8));
    EXPECT_NE(vslam_read_observer(record.data(), record.size(), &observer), VSLAM_GOOD) << bit;
  }
  std::vector<std::uint8_t> longer(good.begin(), good.end());
  longer.resize(good.size() + 60);
  for (std::size_t size = 0; size < longer.size(); ++size) {
    if (size == good.size()) continue;
    // A copy of just that size: the sanitizers see whoever reads beyond it.
    const std::vector<std::uint8_t> cut(longer.begin(), longer.begin() + static_cast<long>(size));
    EXPECT_NE(vslam_read_observer(cut.data(), cut.size(), &observer), VSLAM_GOOD) << size;
  }
  EXPECT_EQ(observer.stamp_ns, 42) << "written by a record that is not good";
}

TEST(Protocol, NoiseIsNoRecord) {
  std::mt19937 random(1);
  VslamObserver observer;
  for (int i = 0; i < 20000; ++i) {
    std::vector<std::uint8_t> noise(random() % 300);
    for (auto& byte : noise) byte = static_cast<std::uint8_t>(random());
    EXPECT_NE(vslam_read_observer(noise.data(), noise.size(), &observer), VSLAM_GOOD);
  }
}

}  // namespace
}  // namespace ardrone_vslam::test
