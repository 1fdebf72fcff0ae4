// SPDX-License-Identifier: BSD-3-Clause
// What the sections say.
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "unit/map_file/map_file_read_fixture.hpp"

namespace ardrone_vslam::test {
namespace {

using MapFileNumbersTest = MapFileReadTest;

constexpr std::size_t kInfo = 0;
constexpr std::size_t kCamera = 1;
constexpr std::size_t kAnchors = 2;
constexpr std::size_t kLandmarks = 3;

TEST_F(MapFileNumbersTest, CountsThatDoNotFitTheirSectionReserveNoMemory) {
  for (const std::uint32_t count : {0U, 2U, 4U, 1101U, 0x10000000U, 0xFFFFFFFFU}) {
    ByteWriter bytes;
    bytes.u32(count);
    EXPECT_NE(faultOfChange(kLandmarks, 0, bytes)
                  .find("section LAND cannot be right: its size does not fit"),
              std::string::npos);
    if (count == 2) continue;
    EXPECT_NE(faultOfChange(kAnchors, 0, bytes)
                  .find("section ANCH cannot be right: its size does not fit"),
              std::string::npos);
  }
}

struct BadNumber {
  std::size_t section;
  std::size_t at;
  std::function<void(ByteWriter&)> write;
  const char* fault;
};

TEST_F(MapFileNumbersTest, NumbersThatCannotBeAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto f64 = [](double v) { return [v](ByteWriter& out) { out.f64(v); }; };
  const auto f32 = [](double v) {
    return [v](ByteWriter& out) { out.f32(static_cast<float>(v)); };
  };
  const auto u32 = [](std::uint32_t v) { return [v](ByteWriter& out) { out.u32(v); }; };
  constexpr std::size_t kPose = 4 + 104;        // of the second anchor
  constexpr std::size_t kMatrix = 4 + 2 * 104;  // covariance of the anchors
  constexpr std::size_t kRecord = 4 + 160;      // of the second landmark
  const BadNumber cases[] = {
      {kInfo, 13, u32(256), "its size does not fit"},
      {kInfo, 17, [](ByteWriter& out) { out.raw("\n", 1); }, "the name of the frame (?ouse)"},
      {kInfo, 22, [](ByteWriter& out) { out.i64(-1); }, "the stamp is negative"},
      {kCamera, 0, u32(0), "the image size is not positive"},
      {kCamera, 4, u32(0x80000000U), "the image size is not positive"},
      {kCamera, 8, f64(nan), "the focal length is not positive"},
      {kCamera, 8, f64(-500), "the focal length is not positive"},
      {kAnchors, kPose + 8, f64(nan), "anchor 2 has a pose that is not finite"},
      {kAnchors, kPose + 32, f64(0.3), "anchor 2 has an attitude that is no rotation"},
      {kAnchors, kPose + 32, f64(nan), "anchor 2 has a pose that is not finite"},
      {kAnchors, kMatrix, f64(-1), "anchor 1 has a variance that is negative or not finite"},
      {kAnchors, kMatrix, f64(nan), "anchor 1 has a variance that is negative or not finite"},
      {kAnchors, kMatrix, f64(0), "not positive semidefinite"},
      {kAnchors, kMatrix + 8, f64(0.1), "not positive semidefinite"},
      {kAnchors, kMatrix + 8, f64(nan), "not positive semidefinite"},
      {kLandmarks, kRecord + 64, f64(nan), "landmark 2 has a position that is not finite"},
      {kLandmarks, kRecord + 88, f32(-1), "landmark 2 has a covariance"},
      {kLandmarks, kRecord + 92, f32(nan), "landmark 2 has a covariance"},
      {kLandmarks, kRecord + 112, f32(0.5), "landmark 2 has a view direction"},
      {kLandmarks, kRecord + 112, f32(nan), "landmark 2 has a view direction"},
      {kLandmarks, kRecord + 124, f32(-1), "landmark 2 has a distance, sigma or parallax"},
      {kLandmarks, kRecord + 136, f32(nan), "landmark 2 has a distance, sigma or parallax"},
      {kLandmarks, kRecord + 140, u32(2), "landmark 2 belongs to an anchor that is not there"},
      {kLandmarks, kRecord + 140, u32(0xFFFFFFFFU), "landmark 2 belongs to an anchor that"},
      {kLandmarks, kRecord + 144, u32(0x80000000U), "landmark 2 has a count that is too large"},
      {kLandmarks, kRecord + 148, u32(0xFFFFFFFFU), "landmark 2 has a count that is too large"}};
  for (const BadNumber& one : cases) {
    ByteWriter bytes;
    one.write(bytes);
    const std::string fault = faultOfChange(one.section, one.at, bytes);
    EXPECT_NE(fault.find(one.fault), std::string::npos) << one.fault << ": " << fault;
    EXPECT_EQ(fault.find("section " + sections_[one.section].tag + " cannot be right: "), 0U);
  }
}

TEST_F(MapFileNumbersTest, ACovarianceIsRefusedForItsWholeNotOnlyForPairs) {
  SavedMap map = smallMap();
  auto& P = map.anchor_covariance;
  P.setIdentity();
  P(1, 0) = P(2, 0) = P(2, 1) = -0.7;  // each pair is possible, the three are not
  EXPECT_THROW(writeMap(path_, map), MapFileError);
  P(1, 0) = P(2, 0) = P(2, 1) = -0.5;  // just singular
  EXPECT_EQ(writeMap(path_, map), 3U);
  EXPECT_EQ(readMap(path_).anchor_covariance(0, 1), -0.5);
}

TEST_F(MapFileNumbersTest, LandmarksAreNumberedFromOne) {
  const SavedMap map = readMap(path_);
  ASSERT_EQ(map.landmarks.size(), 3U);
  for (std::uint32_t i = 0; i < 3; ++i) {
    EXPECT_EQ(map.landmarks[i].id, i + 1);
    EXPECT_EQ(map.landmarks[i].track_id, kNoTrack);
    EXPECT_EQ(map.landmarks[i].anchor_id, 1 + i % 2);
  }
}

}  // namespace
}  // namespace ardrone_vslam::test
