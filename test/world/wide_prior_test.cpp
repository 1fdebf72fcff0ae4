// SPDX-License-Identifier: BSD-3-Clause
// The odometry jumps by metres and says that it may have: windows are of no use then.
#include <gtest/gtest.h>

#include "support/point_flight.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::size_t kJump = 100;  // frame
constexpr std::size_t kFrames = 130;

class WidePrior : public ::testing::Test {
 protected:
  WidePrior() {
    const test::Flight flight = test::lapsFlight(200, 1, 10);
    test::PointWorld world(3);
    world.addRoom({10, 8, 3}, 1500);
    frames_ = test::film(world, flight);
    odometry_ = test::observeExactly(flight);
    frames_.resize(kFrames);
    odometry_.resize(kFrames);
    calm_odometry_ = odometry_;
    for (std::size_t i = kJump; i < kFrames; ++i)
      odometry_[i].T_odom_base.translation() += Eigen::Vector3d(-1.8, 2.2, 0.4);
    // 8 cm of way make a sigma of 0.2 m, a jump of 2.9 m one of 1.2 m.
    config_.thesis_filter.odometry_noise_m_per_sqrt_m = 0.7;
    config_.thesis_filter.mean = MeanKind::kExact;
    // Tracks would find most landmarks as they do in every frame.
    for (auto& track_id : frames_[kJump].track_id) track_id += 1000000;
  }

  const FrameResult& atJump(const test::FlightRun& run) const { return run.results[kJump]; }

  SlamConfig config_ = test::thesisConfig();
  std::vector<ImageFeatures> frames_;
  std::vector<OdometryState> odometry_;
  std::vector<OdometryState> calm_odometry_;  // the same without the jump
};

TEST_F(WidePrior, AllLandmarksAreComparedAndThePoseIsFoundAgain) {
  const auto run = test::run(frames_, odometry_, config_);
  for (std::size_t i = 5; i < kJump; ++i)
    ASSERT_EQ(run.results[i].match_method, MatchMethod::kGuided) << i;
  const FrameResult& result = atJump(run);
  EXPECT_EQ(result.match_method, MatchMethod::kExact);
  EXPECT_GT(result.landmark_matches, 80);  // measured: 123
  EXPECT_EQ(result.state, SlamState::kLocalised);
  const auto calm = test::run(frames_, calm_odometry_, config_);
  const auto offset_m = [&](std::size_t i) {
    return (run.results[i].T_map_base.translation() - calm.results[i].T_map_base.translation())
        .norm();
  };
  EXPECT_LT(offset_m(kJump), 0.12) << "of a jump of 2.9 m";  // measured: 0.08
  for (std::size_t i = kJump + 1; i < kFrames; ++i)
    EXPECT_EQ(run.results[i].match_method, MatchMethod::kGuided) << "narrow again, frame " << i;
  EXPECT_LT(offset_m(kFrames - 1), 0.007);  // measured: 0.0044

  config_.association.max_window_share = 1e6;
  const FrameResult guided = atJump(test::run(frames_, odometry_, config_));
  EXPECT_EQ(guided.match_method, MatchMethod::kGuided);
  EXPECT_LT(guided.landmark_matches, result.landmark_matches)
      << "the landmarks in the image are not those that the prediction puts there";
}

TEST_F(WidePrior, LargeMapsAreSearchedByTheIndexWithTheSameAnswer) {
  const auto exact = test::run(frames_, odometry_, config_);
  config_.association.index_from_landmarks = 300;
  config_.association.index_probes = 1000;  // all lists
  const auto indexed = test::run(frames_, odometry_, config_);
  EXPECT_EQ(atJump(indexed).match_method, MatchMethod::kIndexed);
  for (std::size_t i = 0; i < kFrames; ++i) {
    ASSERT_EQ(indexed.results[i].landmark_matches, exact.results[i].landmark_matches) << i;
    ASSERT_EQ(indexed.results[i].T_map_base.matrix(), exact.results[i].T_map_base.matrix()) << i;
  }
  config_.association.index_probes = 4;
  const FrameResult fewer = atJump(test::run(frames_, odometry_, config_));
  EXPECT_EQ(fewer.match_method, MatchMethod::kIndexed);
  EXPECT_GT(fewer.landmark_matches, atJump(exact).landmark_matches * 2 / 3);  // measured: 0.97
}

TEST_F(WidePrior, NoLandmarkIsWornDownByAPriorThatIsWrong) {
  const auto run = test::run(frames_, odometry_, config_);
  EXPECT_EQ(atJump(run).removed_landmarks, 0);
}

}  // namespace
}  // namespace ardrone_vslam
