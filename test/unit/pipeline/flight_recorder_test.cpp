// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <optional>

#include "ardrone_vslam/flight_record.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::int64_t kFrame_ns = 100'000'000;

/// Flies 0.1 m an image along x; every image is a keyframe that sees the tracks given last.
class Flight {
 public:
  explicit Flight(std::size_t most_bytes = 1'000'000, const SlamConfig& config = {})
      : recorder_(config, Eigen::Isometry3d::Identity(), most_bytes) {}

  std::vector<Landmark> landmarks;
  bool sees_landmarks = true;
  std::optional<PixelInformation> information;  ///< of each feature
  FrameResult result;                           ///< of the next image
  OdometryState odometry;

  void see(std::uint32_t first_track, std::uint32_t count = 10) {
    ImageFeatures features;
    features.stamp_ns = odometry.stamp_ns = stamp_ns_ += kFrame_ns;
    features.focal_length_px = 500;
    for (std::uint32_t i = 0; i < count; ++i) {
      features.pixel_px.emplace_back(100, 100);
      features.bearing_cam.push_back(Eigen::Vector3f::UnitZ());
      features.score.push_back(20);
      features.track_id.push_back(first_track + i);
      features.age_frames.push_back(i == 0 ? 0 : 5);  // the first one is new
      features.descriptor.emplace_back();
    }
    odometry.T_odom_base.translation().x() += 0.1;
    if (information) features.information.resize(count, *information);
    for (Landmark& landmark : landmarks) {
      if (sees_landmarks) landmark.last_seen_ns = stamp_ns_;
    }
    recorder_.see(features, odometry, result, landmarks);
  }
  void seeKeyframe(std::uint32_t first_track, std::uint32_t count = 10) {
    result.is_keyframe = true;
    see(first_track, count);
    result.is_keyframe = false;
  }
  const FlightRecord& record() const { return recorder_.record(); }

 private:
  FlightRecorder recorder_;
  std::int64_t stamp_ns_ = 0;
};

TEST(FlightRecorder, KeepsKeyframesAndWhatLiesBetween) {
  Flight flight;
  flight.seeKeyframe(1);
  flight.see(1);
  flight.see(1);
  flight.seeKeyframe(100);
  const auto& keyframes = flight.record().keyframes;
  ASSERT_EQ(keyframes.size(), 2U);
  EXPECT_EQ(keyframes[0].stamp_ns, kFrame_ns);
  EXPECT_EQ(keyframes[1].stamp_ns, 4 * kFrame_ns);
  EXPECT_NEAR(keyframes[1].way_m, 0.3, 1e-9);
  EXPECT_NEAR(keyframes[1].T_odom_base.translation().x(), 0.4, 1e-9);
  // What the default odometry's white noise makes of three steps.
  const OdometryNoiseConfig noise;
  const double expected =
      std::pow(noise.walk_m_per_sqrt_s, 2) * 0.3 + std::pow(noise.walk_m_per_sqrt_m, 2) * 0.3;
  EXPECT_NEAR(keyframes[1].way_variance_m2, expected, 1e-9);
}

TEST(FlightRecorder, NewTracksAreLeftOutAndOthersKnownAsConfigured) {
  Flight flight;
  flight.seeKeyframe(100);
  EXPECT_EQ(flight.record().keyframes.at(0).views.size(), 10U);  // the first one, too
  flight.seeKeyframe(1);
  const auto& views = flight.record().keyframes.at(1).views;
  ASSERT_EQ(views.size(), 9U);
  EXPECT_EQ(views[0].track_id, 2U);
  EXPECT_NEAR(views[0].information_rad2(0, 0), 500 * 500, 1);  // track_sigma_px is 1
}

TEST(FlightRecorder, KeyframesThatShowTheSameAreOne) {
  Flight flight;
  flight.seeKeyframe(1);
  flight.seeKeyframe(1);  // all of its tracks go on
  EXPECT_EQ(flight.record().keyframes.size(), 1U);
  for (int i = 0; i < 10; ++i) flight.see(1);
  flight.seeKeyframe(1);  // more than a second later
  EXPECT_EQ(flight.record().keyframes.size(), 2U);
}

TEST(FlightRecorder, TracksBelongToTheLandmarksThatAreSeenByThem) {
  Flight flight;
  flight.seeKeyframe(1);
  flight.landmarks.resize(1);
  flight.landmarks[0].id = 7;
  flight.landmarks[0].track_id = 3;
  flight.see(1);
  flight.sees_landmarks = false;
  flight.seeKeyframe(100);
  flight.seeKeyframe(200);
  const auto& keyframes = flight.record().keyframes;
  ASSERT_EQ(keyframes.at(1).landmarks.size(), 1U);
  EXPECT_EQ(keyframes[1].landmarks[0].track_id, 3U);
  EXPECT_EQ(keyframes[1].landmarks[0].landmark_id, 7U);
  EXPECT_TRUE(keyframes.at(2).landmarks.empty());  // it was not seen again
}

TEST(FlightRecorder, FramesThatAreNotKeptHaveTheOdometrysPose) {
  Flight flight;
  flight.seeKeyframe(1);
  flight.see(1);
  flight.seeKeyframe(1);  // all of its tracks go on
  flight.seeKeyframe(100);
  const auto& passed = flight.record().keyframes.at(1).passed;
  ASSERT_EQ(passed.size(), 1U);
  EXPECT_EQ(passed[0].stamp_ns, 3 * kFrame_ns);
  EXPECT_NEAR(passed[0].T_odom_base.translation().x(), 0.3, 1e-9);
}

TEST(FlightRecorder, ItStopsWhereThereIsNoRoom) {
  Flight flight(3 * sizeof(Keyframe) + 25 * sizeof(KeyframeView));
  for (const std::uint32_t first : {1, 100, 200}) flight.seeKeyframe(first);
  // 10 and 9 views, and 10 might come. What would fit later is too far away.
  flight.seeKeyframe(300, 2);
  EXPECT_EQ(flight.record().keyframes.size(), 2U);
  EXPECT_TRUE(flight.record().is_whole);
}

TEST(FlightRecorder, ImagesWithoutFeaturesAreNotKept) {
  Flight flight;
  flight.seeKeyframe(1, 0);
  flight.seeKeyframe(1);
  flight.seeKeyframe(1, 0);
  EXPECT_EQ(flight.record().keyframes.size(), 1U);
}

TEST(FlightRecorder, WhatIsNotKnownAlongAnEdgeIsLeftOut) {
  Flight flight;
  flight.information = PixelInformation{0, 0, 1};
  flight.seeKeyframe(1);
  EXPECT_TRUE(flight.record().keyframes.at(0).views.empty());
}

TEST(FlightRecorder, JumpsOfTheOdometryAreNoWay) {
  Flight flight;
  flight.seeKeyframe(1);
  for (int i = 0; i < 4; ++i) flight.see(1);
  flight.odometry.T_odom_base.translation().x() += 3;
  flight.see(1);
  flight.seeKeyframe(100);
  const Keyframe& last = flight.record().keyframes.back();
  EXPECT_NEAR(last.T_odom_base.translation().x(), 0.7, 0.05);
  EXPECT_GT(last.way_variance_m2, 8);
}

TEST(FlightRecorder, HeightsCountOnceAtTheNextKeyframe) {
  Flight flight;
  flight.odometry.height_m = 1.5;
  flight.result.height = HeightOutcome::kNewFloor;
  flight.see(1);
  flight.result.height = HeightOutcome::kNone;  // too soon after the last one
  flight.odometry.T_odom_base.translation().z() += 0.2;
  flight.seeKeyframe(1);
  flight.seeKeyframe(100);
  flight.result.height = HeightOutcome::kApplied;
  flight.see(100);
  flight.result.height = HeightOutcome::kRejected;
  flight.seeKeyframe(200);
  const auto& keyframes = flight.record().keyframes;
  EXPECT_NEAR(keyframes.at(0).height_m.value_or(0), 1.7, 1e-9);
  EXPECT_FALSE(keyframes.at(1).height_m.has_value());
  EXPECT_FALSE(keyframes.at(2).height_m.has_value());
  EXPECT_EQ(keyframes.at(1).floor, keyframes.at(0).floor);
}

TEST(FlightRecorder, InAPlaneTheHeightIsNone) {
  SlamConfig config;
  config.planar = true;
  Flight flight(1'000'000, config);
  flight.result.height = HeightOutcome::kApplied;
  flight.odometry.T_odom_base.translation().z() = 0.3;  // which the odometry makes up
  flight.seeKeyframe(1);
  EXPECT_NEAR(flight.record().keyframes.at(0).height_m.value_or(1), 0, 1e-9);
}

TEST(FlightRecorder, AFlightThatBeginsAnewIsNotWhole) {
  Flight flight;
  flight.seeKeyframe(1);
  EXPECT_TRUE(flight.record().is_whole);
  ++flight.odometry.start;  // the driver was started again
  flight.seeKeyframe(100);
  flight.seeKeyframe(200);
  EXPECT_FALSE(flight.record().is_whole);
  EXPECT_TRUE(flight.record().keyframes.empty());
  Flight carried;
  carried.seeKeyframe(1);
  carried.result.revisit_m = 3;
  carried.seeKeyframe(100);
  carried.result.revisit_m = 0;
  carried.seeKeyframe(200);
  EXPECT_FALSE(carried.record().is_whole) << "its odometry does not say how it came there";
  Flight searching;
  searching.result.state = SlamState::kSearchingMap;
  searching.seeKeyframe(1);
  searching.result.state = SlamState::kRelocated;
  searching.seeKeyframe(100);
  EXPECT_FALSE(searching.record().is_whole);
}

}  // namespace
}  // namespace ardrone_vslam
