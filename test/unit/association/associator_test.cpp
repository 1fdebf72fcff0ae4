// SPDX-License-Identifier: BSD-3-Clause
#include "association/associator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "association/map_feature_associator.hpp"
#include "support/view_builder.hpp"

namespace ardrone_vslam {
namespace {

using test::ViewBuilder;

constexpr double kFocalLength_px = test::kPointFocalLength_px;

class AssociatorTest : public ::testing::Test {
 protected:
  AssociatorTest() {
    builder_.lookFrom({0, 0, 0});
    builder_.addFrame();
  }

  /// A landmark on the optical axis.
  int addLandmark(double distance_m, std::uint32_t track_id, const Descriptor& descriptor) {
    Landmark landmark;
    landmark.position_map << distance_m, 0, 0;
    landmark.view_direction_map = Eigen::Vector3f::UnitX();
    landmark.track_id = track_id;
    landmark.descriptor = descriptor;
    landmarks_.add(landmark);
    return static_cast<int>(landmarks_.size()) - 1;
  }
  AssociationResult matchLandmarks() {
    AssociationResult result;
    Associator(config_).matchLandmarks(builder_.view(), landmarks_, result);
    return result;
  }
  AssociationResult matchMapFeatures(const std::vector<bool>& taken = {}) {
    AssociationResult result;
    std::vector<bool> marks = taken;
    marks.resize(builder_.features().size(), false);
    MapFeatureAssociator(config_).match(builder_.view(), map_features_, marks, result);
    return result;
  }
  void storeRay(const Eigen::Vector3d& origin, const Eigen::Vector3d& point, std::uint32_t track_id,
                const Descriptor& descriptor = {}) {
    MapFeature feature;
    feature.track_id = track_id;
    feature.ray = {origin, (point - origin).normalized()};
    feature.descriptor = descriptor;
    map_features_.add(feature);
  }

  AssociationConfig config_;
  ViewBuilder builder_;
  LandmarkMap landmarks_{LandmarkMapConfig{}};
  FeatureMap map_features_{FeatureMapConfig{}};
};

TEST_F(AssociatorTest, FindsALandmarkByItsDescriptorWithinTheWindow) {
  const Descriptor a = builder_.randomDescriptor();
  config_.search_radius_px = 30;
  config_.landmark_threshold_px = 100;
  const int target = addLandmark(5, kNoTrack, a);
  const int feature = builder_.addPixel(29, 0, 1, builder_.flipped(a, 40));
  const auto near = matchLandmarks();
  ASSERT_EQ(near.matches.size(), 1U);
  EXPECT_EQ(near.matches[0].target, target);
  EXPECT_EQ(near.matches[0].feature, feature);
  EXPECT_EQ(near.in_view, 1);
  EXPECT_TRUE(near.missed.empty());

  builder_.lookFrom({0, 0, 0});
  builder_.addPixel(31, 0, 1, a);
  const auto far = matchLandmarks();
  EXPECT_TRUE(far.matches.empty());
  EXPECT_EQ(far.missed, std::vector<int>{target});
}

TEST_F(AssociatorTest, RemovesLandmarkMatchesOffThePrediction) {
  config_.landmark_threshold_px = 8;
  for (const double off_px : {7.9, 8.1}) {
    landmarks_ = LandmarkMap({});
    builder_.lookFrom({0, 0, 0});
    const Descriptor a = builder_.randomDescriptor();
    addLandmark(5, kNoTrack, a);
    builder_.addPixel(0, off_px, 1, a);
    const auto result = matchLandmarks();
    EXPECT_EQ(result.candidates, 1);
    EXPECT_EQ(result.matches.size(), off_px < 8 ? 1U : 0U) << off_px;
    EXPECT_EQ(result.mismatches, off_px < 8 ? 0 : 1);
    EXPECT_EQ(result.missed.size(), off_px < 8 ? 0U : 1U) << "a mismatch is a miss";
  }
}

TEST_F(AssociatorTest, ThresholdAndWindowGrowWithTheSigmaOfThePose) {
  config_.landmark_threshold_px = 8;
  config_.search_radius_px = 10;
  config_.threshold_sigmas = 3;
  const Descriptor a = builder_.randomDescriptor();
  addLandmark(5, kNoTrack, a);
  const double sigma_m = 0.05;
  const double margin_px = 3 * kFocalLength_px * sigma_m / 5;  // 17.1
  const auto matches = [&](double off_px, bool common_drift, double shared_m2) {
    landmarks_.at(0).position_variance_m2 = static_cast<float>(shared_m2);
    builder_.lookFrom({0, 0, 0});
    builder_.addPixel(0, off_px, 1, a);
    builder_.view().setPositionVariance(sigma_m * sigma_m, common_drift);
    return matchLandmarks().matches.size();
  };
  EXPECT_EQ(matches(8 + margin_px - 0.2, true, 0), 1U);
  EXPECT_EQ(matches(8 + margin_px + 0.2, true, 0), 0U);
  const double all_m2 = sigma_m * sigma_m;
  EXPECT_EQ(matches(7.8, true, all_m2), 1U);
  EXPECT_EQ(matches(8.2, true, all_m2), 0U) << "no drift since the landmark was made";
  EXPECT_EQ(matches(8 + margin_px - 0.2, false, all_m2), 1U) << "without common drift all counts";
  config_.threshold_sigmas = 0;
  EXPECT_EQ(matches(8.2, false, 0), 0U) << "fixed thresholds";
}

TEST_F(AssociatorTest, TracksComeFirstAndNeedNoDescriptor) {
  const Descriptor a = builder_.randomDescriptor();
  addLandmark(5, 42, a);
  builder_.addPixel(0, 0, 7, a);  // looks the same, but is another track
  const int followed = builder_.addPixel(2, 0, 42, builder_.randomDescriptor());
  const auto result = matchLandmarks();
  ASSERT_EQ(result.matches.size(), 1U);
  EXPECT_EQ(result.matches[0].feature, followed);
}

TEST_F(AssociatorTest, ATrackThatLeftItsLandmarkIsAMismatchAndTheDescriptorDecides) {
  const Descriptor a = builder_.randomDescriptor();
  const int target = addLandmark(5, 42, a);
  builder_.addPixel(100, 0, 42, builder_.randomDescriptor());
  const int right = builder_.addPixel(1, 0, 7, a);
  const auto result = matchLandmarks();
  ASSERT_EQ(result.matches.size(), 1U);
  EXPECT_EQ(result.matches[0].target, target);
  EXPECT_EQ(result.matches[0].feature, right);
  EXPECT_EQ(result.candidates, 2);
  EXPECT_EQ(result.mismatches, 1);
}

TEST_F(AssociatorTest, EachFeatureAndEachLandmarkOnce) {
  const Descriptor a = builder_.randomDescriptor();
  for (const bool cross_check : {true, false}) {
    config_.matcher.cross_check = cross_check;
    config_.matcher.ratio = 1;
    landmarks_ = LandmarkMap({});
    builder_.lookFrom({0, 0, 0});
    for (int i = 0; i < 6; ++i) addLandmark(5 + 0.1 * i, 0, builder_.flipped(a, 10 + i));
    for (int i = 0; i < 4; ++i) builder_.addPixel(i, 0, 0, builder_.flipped(a, 10 + i));
    const auto result = matchLandmarks();
    std::set<int> targets;
    std::set<int> features;
    for (const Association& match : result.matches) {
      EXPECT_TRUE(targets.insert(match.target).second);
      EXPECT_TRUE(features.insert(match.feature).second);
    }
    EXPECT_FALSE(result.matches.empty());
    EXPECT_EQ(result.matches.size() + result.missed.size(), 6U);
  }
}

TEST_F(AssociatorTest, CrossCheckAsksTheFeatureToo) {
  const Descriptor a = builder_.randomDescriptor();
  config_.matcher.ratio = 1;
  addLandmark(5, 0, builder_.flipped(a, 30));  // likes the feature, which likes the other one more
  addLandmark(6, 0, a);
  builder_.addPixel(0, 0, 1, a);
  const auto winner = [this](bool cross_check) {
    config_.matcher.cross_check = cross_check;
    const auto result = matchLandmarks();
    return result.matches.size() == 1 ? result.matches[0].target : -1;
  };
  EXPECT_EQ(winner(true), 1);
  EXPECT_EQ(winner(false), 0) << "first come, first served";
}

TEST_F(AssociatorTest, LandmarksBehindOutsideOrSeenFromElsewhereAreNotInView) {
  const Descriptor a = builder_.randomDescriptor();
  config_.max_view_angle_deg = 60;
  addLandmark(-5, 0, a);
  addLandmark(5, 0, a);
  landmarks_.at(1).position_map << 5, 10, 0;  // 63 degrees to the left, outside
  landmarks_.at(1).view_direction_map = landmarks_.at(1).position_map.normalized().cast<float>();
  addLandmark(5, 0, a);
  const auto seenAt = [](double angle_deg) -> Eigen::Vector3f {
    const double angle_rad = angle_deg * M_PI / 180;
    return Eigen::Vector3d(std::cos(angle_rad), std::sin(angle_rad), 0).cast<float>();
  };
  landmarks_.at(2).view_direction_map = seenAt(61);
  addLandmark(0, 0, a);  // at the camera itself
  EXPECT_EQ(matchLandmarks().in_view, 0);
  landmarks_.at(2).view_direction_map = seenAt(59);
  EXPECT_EQ(matchLandmarks().in_view, 1);
}

TEST_F(AssociatorTest, LandmarksSeenFromMuchNearerOrFurtherAreNotInView) {
  config_.max_distance_ratio = 4;
  addLandmark(5, 0, builder_.randomDescriptor());
  const auto inView = [this](double seen_distance_m) {
    landmarks_.at(0).seen_distance_m = static_cast<float>(seen_distance_m);
    return matchLandmarks().in_view;
  };
  EXPECT_EQ(inView(1.2), 0);
  EXPECT_EQ(inView(1.3), 1);
  EXPECT_EQ(inView(19.9), 1);
  EXPECT_EQ(inView(20.1), 0);
  EXPECT_EQ(inView(0), 1) << "not known";
}

TEST_F(AssociatorTest, MapFeaturesByTrackWithinTheEpipolarPlane) {
  config_.epipolar_threshold_px = 2;
  storeRay({0, 0.5, 0}, {5, 0, 0}, 3);  // camera came from the left: epipolar lines are rows
  const auto judged = [&](double right_px, double down_px) {
    builder_.lookFrom({0, 0, 0});
    builder_.addPixel(right_px, down_px, 3);
    return matchMapFeatures();
  };
  EXPECT_EQ(judged(0, 1.9).matches.size(), 1U);
  EXPECT_EQ(judged(0, 2.1).mismatches, 1);
  // The first ray, seen at infinity, stands 57 px to the right.
  EXPECT_EQ(judged(55, 0).matches.size(), 1U);
  EXPECT_EQ(judged(60, 0).mismatches, 1) << "the rays diverge";
}

TEST_F(AssociatorTest, MapFeaturesWhoseLinesMeetBehindTheFirstCameraAreMismatches) {
  // Moving backward along x past a point that was seen to the left.
  config_.epipolar_threshold_px = 2;
  storeRay({1, 0, 0}, {1.2, 1, 0}, 3);
  builder_.lookFrom({0, 0, 0});
  builder_.addPixel(10, 0, 3);  // right of the direction of motion
  const auto result = matchMapFeatures();
  EXPECT_EQ(result.candidates, 1);
  EXPECT_EQ(result.mismatches, 1);
}

TEST_F(AssociatorTest, EpipolarTestAllowsForAnUncertainBaseline) {
  config_.epipolar_threshold_px = 2;
  config_.threshold_sigmas = 3;
  storeRay({0, 0.02, 0}, {1, 0, 0}, 3);
  const auto mismatches = [&](double sigma_m) {
    builder_.lookFrom({0, 0, 0});
    builder_.addPixel(0, 6, 3);  // a parallax of 6 px across the presumed plane
    builder_.view().setPositionVariance(sigma_m * sigma_m, true);
    return matchMapFeatures().mismatches;
  };
  EXPECT_EQ(mismatches(0), 1);
  EXPECT_EQ(mismatches(0.02), 0) << "the baseline may as well point down";
}

TEST_F(AssociatorTest, MapFeaturesWithoutABaselineAreKept) {
  storeRay({0, 0, 0}, {5, 0, 0}, 3);
  builder_.addPixel(20, 20, 3);
  EXPECT_EQ(matchMapFeatures().matches.size(), 1U);
}
TEST_F(AssociatorTest, EndedTracksAreFoundByDescriptor) {
  const Descriptor a = builder_.randomDescriptor();
  storeRay({0, 0.5, 0}, {100, 0, 0}, 3, a);
  const int taken = builder_.addPixel(1, 0, 8, a);
  const int feature = builder_.addPixel(0, 0, 9, builder_.flipped(a, 30));
  EXPECT_EQ(matchMapFeatures().matches.size(), 1U);
  std::vector<bool> marks(builder_.features().size(), false);
  marks[static_cast<std::size_t>(taken)] = true;
  const auto result = matchMapFeatures(marks);
  ASSERT_EQ(result.matches.size(), 1U);
  EXPECT_EQ(result.matches[0].feature, feature) << "features of landmarks are not offered";
}

TEST_F(AssociatorTest, EntriesOfLivingTracksAreNotSearchedByDescriptor) {
  const Descriptor a = builder_.randomDescriptor();
  storeRay({0, 0.5, 0}, {100, 0, 0}, 3, a);
  builder_.addPixel(0, 100, 3, builder_.randomDescriptor());  // off the plane
  builder_.addPixel(0, 0, 9, a);
  const auto result = matchMapFeatures();
  EXPECT_TRUE(result.matches.empty());
  EXPECT_EQ(result.mismatches, 1);
}

TEST_F(AssociatorTest, PlanarModeTestsTheOrderOfTheBearings) {
  storeRay({0, 0.5, 0}, {5, 0, 0}, 3);
  const auto judged = [&](double right_px, double down_px) {
    builder_.lookFrom({0, 0, 0}, true);
    builder_.addPixel(right_px, down_px, 3);
    return matchMapFeatures();
  };
  EXPECT_EQ(judged(0, 90).matches.size(), 1U) << "height does not count";
  EXPECT_EQ(judged(50, -90).matches.size(), 1U);
  EXPECT_EQ(judged(65, 0).mismatches, 1) << "diverging";
}

TEST_F(AssociatorTest, PlanarModeSearchesLandmarksAtTheirHeight) {
  const Descriptor a = builder_.randomDescriptor();
  config_.search_radius_px = 10;
  addLandmark(5, 0, a);
  landmarks_.at(0).height_m = 1;
  builder_.lookFrom({1, 0, 0}, true);
  builder_.addPoint({5, 0, 1}, 9, a);  // 4 m away: 142 px above the axis
  builder_.addFrame();
  EXPECT_EQ(matchLandmarks().matches.size(), 1U);
  landmarks_.at(0).height_m = 0;
  EXPECT_EQ(matchLandmarks().candidates, 0);
}

TEST_F(AssociatorTest, EmptyFramesAndMapsMatchNothing) {
  EXPECT_TRUE(matchLandmarks().matches.empty());
  EXPECT_TRUE(matchMapFeatures().matches.empty());
  addLandmark(5, 1, {});
  storeRay({0, 0.5, 0}, {5, 0, 0}, 3);
  builder_.lookFrom({0, 0, 0});
  EXPECT_TRUE(matchLandmarks().matches.empty());
  EXPECT_TRUE(matchMapFeatures().matches.empty());
}

}  // namespace
}  // namespace ardrone_vslam
