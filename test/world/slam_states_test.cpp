// SPDX-License-Identifier: BSD-3-Clause
// Every state that Slam can report, and what must not wear its map down.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/point_flight.hpp"

namespace ardrone_vslam {
namespace {

using test::Flight;

class SlamStates : public ::testing::Test {
 protected:
  SlamStates() : flight_(test::lapsFlight(200, 1, 10)), world_(1) {
    world_.addRoom({10, 8, 3}, 1200);
    odometry_ = test::observeExactly(flight_);
  }

  ImageFeatures look(std::size_t frame) {
    return world_.look(flight_[frame].T_map_base * test::forwardExtrinsics(),
                       flight_[frame].stamp_ns);
  }
  ImageFeatures dark(std::size_t frame) { return world_.emptyView(flight_[frame].stamp_ns); }

  Flight flight_;
  test::PointWorld world_;
  std::vector<OdometryState> odometry_;
};

TEST_F(SlamStates, BuildingThenLocalisedThenTooFew) {
  Slam slam(test::thesisConfig(), test::forwardExtrinsics());
  EXPECT_EQ(slam.process(look(0), odometry_[0]).state, SlamState::kBuildingMap);
  EXPECT_EQ(slam.landmarks().size(), 0U);
  for (std::size_t i = 1; i < 40; ++i) slam.process(look(i), odometry_[i]);
  const FrameResult good = slam.process(look(40), odometry_[40]);
  EXPECT_EQ(good.state, SlamState::kLocalised);
  EXPECT_TRUE(good.landmark_position_map);
  EXPECT_GT(good.landmark_sigma_m, 0);
  EXPECT_GE(good.landmark_candidates, good.landmark_matches);
  EXPECT_GE(good.landmarks_in_view, good.landmark_matches);

  const FrameResult blind = slam.process(dark(41), odometry_[41]);
  EXPECT_EQ(blind.state, SlamState::kTooFewLandmarks);
  EXPECT_FALSE(blind.landmark_position_map);
  EXPECT_EQ(blind.landmark_matches, 0);
  const Eigen::Vector3d increment =
      odometry_[41].T_odom_base.translation() - odometry_[40].T_odom_base.translation();
  EXPECT_LT((blind.T_map_base.translation() - good.T_map_base.translation() - increment).norm(),
            1e-12)
      << "the pose follows the odometry";
}

TEST_F(SlamStates, OneLandmarkMissingIsTooFew) {
  SlamConfig config = test::thesisConfig();
  config.thesis_filter.min_landmarks = 1000;
  Slam slam(config, test::forwardExtrinsics());
  FrameResult last;
  for (std::size_t i = 0; i < 30; ++i) last = slam.process(look(i), odometry_[i]);
  EXPECT_EQ(last.state, SlamState::kTooFewLandmarks);
  EXPECT_GT(last.landmark_matches, 80);  // measured: 118
}

TEST_F(SlamStates, FixRejected) {
  SlamConfig config = test::thesisConfig();
  config.thesis_filter.gate_sigmas = 0.5;
  config.thesis_filter.fix_angle_floor_deg = 0;
  config.thesis_filter.common_drift = false;
  config.thesis_filter.odometry_noise_m_per_sqrt_s = 0.001;
  Slam slam(config, test::forwardExtrinsics());
  for (std::size_t i = 0; i < 40; ++i) slam.process(look(i), odometry_[i]);
  OdometryState jumped = odometry_[40];
  jumped.T_odom_base.translation() += Eigen::Vector3d(0.02, 0.02, 0.02);
  const FrameResult result = slam.process(look(40), jumped);
  EXPECT_EQ(result.state, SlamState::kFixRejected);
  EXPECT_TRUE(result.landmark_position_map) << "shown, though not used";
}

TEST_F(SlamStates, NotFiniteIsNamedAndLeavesTheMapAlone) {
  const double kLargest = std::numeric_limits<double>::max();
  for (const double bad : {std::nan(""), kLargest, -kLargest}) {
    Slam slam(test::thesisConfig(), test::forwardExtrinsics());
    for (std::size_t i = 0; i < 40; ++i) {
      EXPECT_TRUE(isFinite(slam.process(look(i), odometry_[i])));
    }
    const std::size_t landmarks = slam.landmarks().size();
    ASSERT_GT(landmarks, 0U);
    OdometryState overflowing = odometry_[40];
    overflowing.T_odom_base.translation().setConstant(bad);
    const FrameResult result = slam.process(look(40), overflowing);
    EXPECT_EQ(result.state, SlamState::kNotFinite) << bad;
    EXPECT_FALSE(isFinite(result));
    EXPECT_EQ(result.landmark_matches, 0) << "not those of the image before";
    EXPECT_EQ(slam.landmarks().size(), landmarks);
    EXPECT_EQ(slam.process(look(41), odometry_[41]).state, SlamState::kBuildingMap);
    EXPECT_TRUE(slam.landmarks().empty()) << "the thesis's map begins anew";
  }
}

TEST_F(SlamStates, AfterWhatWasNotFiniteTheFlightIsFoundInItsMap) {
  constexpr std::size_t kBad = 260;
  flight_ = test::lapsFlight(200, 2, 10);
  odometry_ = test::observeExactly(flight_);
  const double kLargest = std::numeric_limits<double>::max();
  for (const double bad : {std::nan(""), kLargest, -kLargest}) {
    Slam slam(test::configForDrift(), test::forwardExtrinsics());
    for (std::size_t i = 0; i < kBad; ++i) slam.process(look(i), odometry_[i]);
    const std::size_t landmarks = slam.landmarks().size();
    OdometryState overflowing = odometry_[kBad];
    overflowing.T_odom_base.translation().setConstant(bad);
    EXPECT_EQ(slam.process(look(kBad), overflowing).state, SlamState::kNotFinite) << bad;
    std::size_t found = 0;
    for (std::size_t i = kBad + 1; i < flight_.size(); ++i) {
      const FrameResult result = slam.process(look(i), odometry_[i]);
      ASSERT_TRUE(isFinite(result)) << bad << " frame " << i;
      if (result.state == SlamState::kSearchingMap) continue;
      if (found == 0) found = i;
      EXPECT_LT((result.T_map_base.translation() - flight_[i].T_map_base.translation()).norm(),
                0.02)
          << bad << " frame " << i;
    }
    EXPECT_GT(found, kBad + 1) << bad;
    EXPECT_LT(found, kBad + 10) << bad;
    EXPECT_GE(slam.landmarks().size(), landmarks) << bad;
  }
}

TEST(FrameResultCheck, EveryNumberOfThePoseCounts) {
  const double kInfinite = std::numeric_limits<double>::infinity();
  const double kLargest = std::numeric_limits<double>::max();
  FrameResult good;
  EXPECT_TRUE(isFinite(good));
  std::vector<FrameResult> bad(6, good);
  bad[0].T_map_base.translation().y() = kInfinite;
  bad[1].T_map_base.linear()(2, 0) = std::nan("");
  bad[2].T_odom_base.translation().x() = std::nan("");
  bad[3].covariance(5, 4) = -kInfinite;
  bad[4].sigma_m = kInfinite;
  bad[5].T_map_base.translation().x() = kLargest;  // finite, but T_map_odom is not
  bad[5].T_odom_base.translation().x() = -kLargest;
  for (std::size_t i = 0; i < bad.size(); ++i) EXPECT_FALSE(isFinite(bad[i])) << i;
}

TEST(MountingCheck, TheCameraIsOnTheDrone) {
  Eigen::Isometry3d T_base_cam = test::forwardExtrinsics();
  EXPECT_EQ(extrinsicsFault(T_base_cam), "");
  T_base_cam.translation().y() = -kFarthestCamera_m;
  EXPECT_EQ(extrinsicsFault(T_base_cam), "");
  for (const double metres : {100.1, -1e300}) {
    T_base_cam.translation().y() = metres;
    EXPECT_NE(extrinsicsFault(T_base_cam).find("beyond 100 m; correct"), std::string::npos);
    EXPECT_THROW(Slam({}, T_base_cam), std::invalid_argument);
  }
  T_base_cam.translation().y() = std::nan("");
  EXPECT_NE(extrinsicsFault(T_base_cam).find("not finite"), std::string::npos);
}

TEST_F(SlamStates, OdometryOnly) {
  SlamConfig config;
  config.estimator = EstimatorKind::kOdometry;
  Slam slam(config, test::forwardExtrinsics());
  EXPECT_EQ(slam.process(look(0), odometry_[0]).state, SlamState::kOdometryOnly);
}

TEST_F(SlamStates, EachHasAnExplanationExceptTheGoodOne) {
  std::set<std::string> sentences;
  for (const SlamState state :
       {SlamState::kBuildingMap, SlamState::kTooFewLandmarks, SlamState::kFixRejected,
        SlamState::kOdometryOnly, SlamState::kBlind}) {
    EXPECT_STRNE(explain(state), "");
    sentences.insert(explain(state));
  }
  EXPECT_EQ(sentences.size(), 5U);
  EXPECT_STREQ(explain(SlamState::kLocalised), "");
}

TEST_F(SlamStates, NothingButDarkImages) {
  Slam slam(test::thesisConfig(), test::forwardExtrinsics());
  for (std::size_t i = 0; i < 100; ++i) {
    const FrameResult& result = slam.process(dark(i), odometry_[i]);
    ASSERT_EQ(result.state, SlamState::kBuildingMap);
    ASSERT_TRUE(result.T_map_base.matrix().allFinite());
    ASSERT_TRUE(result.covariance.allFinite());
    ASSERT_EQ(result.landmarks + result.map_features + result.features, 0);
  }
}

TEST_F(SlamStates, WithoutTracksThatGoOnItIsBlind) {
  SlamConfig config = test::thesisConfig();
  config.estimator = EstimatorKind::kMsckf;
  Slam slam(config, test::forwardExtrinsics());
  EXPECT_EQ(slam.process(dark(0), odometry_[0]).state, SlamState::kBuildingMap);
  EXPECT_EQ(slam.process(dark(1), odometry_[1]).state, SlamState::kBlind);
  EXPECT_EQ(slam.process(look(2), odometry_[2]).state, SlamState::kBlind) << "all are new";
  for (std::size_t i = 3; i < 60; ++i)
    EXPECT_NE(slam.process(look(i), odometry_[i]).state, SlamState::kBlind);
  const FrameResult ended = slam.process(dark(60), odometry_[60]);
  EXPECT_EQ(ended.state, SlamState::kTracking) << "by the tracks that end";
  EXPECT_GT(ended.feature_matches, 0);
  const FrameResult blind = slam.process(dark(61), odometry_[61]);
  EXPECT_EQ(blind.state, SlamState::kBlind);
  EXPECT_EQ(blind.feature_matches, 0);
  ImageFeatures blurred = look(62);
  blurred.age_frames.assign(blurred.size(), 0);
  EXPECT_EQ(slam.process(blurred, odometry_[62]).state, SlamState::kBlind) << "none goes on";
  EXPECT_NE(slam.process(look(63), odometry_[63]).state, SlamState::kBlind);
}

TEST_F(SlamStates, DarkImagesDoNotWearTheMapDown) {
  Slam slam(test::thesisConfig(), test::forwardExtrinsics());
  for (std::size_t i = 0; i < 60; ++i) slam.process(look(i), odometry_[i]);
  const std::size_t landmarks = slam.landmarks().size();
  int removed = 0;
  for (std::size_t i = 60; i < 80; ++i)
    removed += slam.process(dark(i), odometry_[i]).removed_landmarks;
  EXPECT_EQ(removed, 0);
  EXPECT_EQ(slam.landmarks().size(), landmarks);
  FrameResult after;
  for (std::size_t i = 80; i < 84; ++i) after = slam.process(look(i), odometry_[i]);
  EXPECT_EQ(after.state, SlamState::kLocalised) << "found again after 2 s without an image";
}

TEST_F(SlamStates, HoveringMakesNoLandmarks) {
  Slam slam(test::thesisConfig(), test::forwardExtrinsics());
  FrameResult last;
  for (std::size_t i = 0; i < 100; ++i) {
    ImageFeatures features =
        world_.look(flight_[0].T_map_base * test::forwardExtrinsics(), flight_[i].stamp_ns);
    OdometryState still = odometry_[0];
    still.stamp_ns = flight_[i].stamp_ns;
    last = slam.process(features, still);
  }
  EXPECT_EQ(last.landmarks, 0) << "there is no parallax";
  EXPECT_LE(last.map_features, FeatureMapConfig{}.max_map_features);
  EXPECT_EQ(last.state, SlamState::kBuildingMap);
}

TEST_F(SlamStates, CapsHold) {
  SlamConfig config = test::thesisConfig();
  config.feature_map.max_map_features = 50;
  config.landmark_map.max_landmarks = 60;
  Slam slam(config, test::forwardExtrinsics());
  for (std::size_t i = 0; i < flight_.size(); ++i) {
    const FrameResult& result = slam.process(look(i), odometry_[i]);
    ASSERT_LE(result.map_features, 50);
    ASSERT_LE(result.landmarks, 60);
    ASSERT_EQ(static_cast<std::size_t>(result.landmarks), slam.landmarks().size());
  }
  EXPECT_GT(slam.landmarks().size(), 33U);  // measured: 50
}

TEST_F(SlamStates, MountingOfTheCameraIsTakenIntoAccount) {
  Eigen::Isometry3d T_base_cam = test::forwardExtrinsics();
  T_base_cam.translation() << 0.3, 0.1, -0.05;
  T_base_cam.linear() =
      Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()).toRotationMatrix() * T_base_cam.linear();
  Slam slam(test::thesisConfig(), T_base_cam);
  double largest_m = 0;
  int matches = 0;
  for (std::size_t i = 0; i < flight_.size(); ++i) {
    const FrameResult& result = slam.process(
        world_.look(flight_[i].T_map_base * T_base_cam, flight_[i].stamp_ns), odometry_[i]);
    largest_m = std::max(
        largest_m, (result.T_map_base.translation() - flight_[i].T_map_base.translation()).norm());
    matches += result.landmark_matches;
  }
  EXPECT_LT(largest_m, 0.007);                                 // measured: 0.0046
  EXPECT_GT(matches, 100 * static_cast<int>(flight_.size()));  // measured: 147
}

}  // namespace
}  // namespace ardrone_vslam
