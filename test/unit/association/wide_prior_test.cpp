// SPDX-License-Identifier: BSD-3-Clause
// How landmarks are looked for when the prediction is too uncertain to say where.
#include <gtest/gtest.h>

#include "association/associator.hpp"
#include "support/view_builder.hpp"

namespace ardrone_vslam {
namespace {

/// 40 landmarks with descriptors of their own, 5 m ahead in a row; the camera sees them from
/// elsewhere.
class WidePriorTest : public ::testing::Test {
 protected:
  WidePriorTest() {
    builder_.lookFrom({0, 0, 0});
    builder_.addFrame();
    builder_.view();
    for (int i = 0; i < 40; ++i) {
      const Descriptor descriptor = builder_.randomDescriptor();
      Landmark landmark;
      landmark.position_map << 5, 0.05 * (i - 20), 0;
      landmark.view_direction_map = Eigen::Vector3f::UnitX();
      landmark.seen_distance_m = 5;
      landmark.descriptor = descriptor;
      landmarks_.add(landmark);
      features_of_all_.push_back(builder_.flipped(descriptor, 30));
    }
  }
  /// The whole row is seen 250 px to the right of where the prediction puts it.
  AssociationResult look(double sigma_m) {
    builder_.lookFrom({0, 0, 0});
    for (std::size_t i = 0; i < 40; ++i) {
      const double right_px = test::kPointFocalLength_px * 0.01 * (20.0 - static_cast<double>(i));
      builder_.addPixel(right_px + 250, 0, kNoTrack, features_of_all_[i]);
    }
    builder_.view().setPositionVariance(sigma_m * sigma_m, true);
    return matchLandmarks();
  }

  AssociationResult matchLandmarks() {
    AssociationResult result;
    Associator(config_).matchLandmarks(builder_.view(), landmarks_, result);
    return result;
  }

  AssociationConfig config_;
  test::ViewBuilder builder_;
  LandmarkMap landmarks_{LandmarkMapConfig{}};
  std::vector<Descriptor> features_of_all_;
};

TEST_F(WidePriorTest, TheMethodFollowsTheWindows) {
  // 3 sigmas at 5 m: 342 px a metre. Half the image is 320 px.
  EXPECT_EQ(look(0.8).method, MatchMethod::kGuided);
  const auto exact = look(0.9);
  EXPECT_EQ(exact.method, MatchMethod::kExact);
  EXPECT_EQ(exact.matches.size(), 40U);
  EXPECT_EQ(exact.in_view, 40);
  config_.index_from_landmarks = 40;
  const auto indexed = look(0.9);
  EXPECT_EQ(indexed.method, MatchMethod::kIndexed);
  EXPECT_EQ(indexed.matches.size(), 40U);
  for (const Association& match : indexed.matches) EXPECT_EQ(match.target, match.feature);
  config_.max_window_share = 2;
  EXPECT_EQ(look(0.9).method, MatchMethod::kGuided);
}

TEST_F(WidePriorTest, LargeMapsAreSearchedExactlyUntilTheirIndexIsBuilt) {
  config_.index_from_landmarks = 40;
  Landmark elsewhere;
  elsewhere.position_map << -50, 0, 0;
  elsewhere.view_direction_map = -Eigen::Vector3f::UnitX();
  elsewhere.seen_distance_m = 5;
  for (int i = 0; i < 2 * LandmarkMap::kIndexStep; ++i) {
    elsewhere.descriptor = builder_.randomDescriptor();
    landmarks_.add(elsewhere);
  }
  EXPECT_EQ(look(0.1).method, MatchMethod::kGuided);
  for (const MatchMethod expected :
       {MatchMethod::kExact, MatchMethod::kExact, MatchMethod::kIndexed, MatchMethod::kIndexed}) {
    const auto result = look(0.9);
    EXPECT_EQ(result.method, expected);
    EXPECT_EQ(result.matches.size(), 40U);
  }
  // Few changes are caught up with at once.
  landmarks_.at(3).descriptor = builder_.randomDescriptor();
  EXPECT_EQ(look(0.9).method, MatchMethod::kIndexed);
  EXPECT_EQ(look(0.9).matches.size(), 39U);
}

TEST_F(WidePriorTest, FewProbesFindFewerMatches) {
  config_.index_from_landmarks = 40;
  for (int i = 0; i < 3000; ++i) {
    Landmark landmark;
    landmark.position_map << 50, 0, 0;
    landmark.descriptor = builder_.randomDescriptor();
    landmarks_.add(landmark);
  }
  for (Descriptor& descriptor : features_of_all_) descriptor = builder_.flipped(descriptor, 50);
  config_.index_probes = 1000;
  EXPECT_EQ(look(0.9).matches.size(), 40U);
  config_.index_probes = 1;
  EXPECT_LT(look(0.9).matches.size(), 40U);
}

TEST_F(WidePriorTest, MismatchesAreStillRemovedAndNobodyIsMissed) {
  config_.threshold_sigmas = 1;
  config_.search_radius_px = 400;  // wide windows, though the prior is narrow
  const auto result = look(0);
  EXPECT_EQ(result.method, MatchMethod::kExact);
  EXPECT_EQ(result.candidates, 40);
  EXPECT_EQ(result.mismatches, 40);
  EXPECT_TRUE(result.matches.empty());
  EXPECT_TRUE(result.missed.empty());
}

TEST_F(WidePriorTest, LandmarksThePredictionDoesNotShowAreFoundToo) {
  for (std::size_t i = 0; i < 40; ++i) landmarks_.at(i).position_map.y() += 4.5;
  const auto result = look(5);
  EXPECT_EQ(result.in_view, 0);
  EXPECT_EQ(result.method, MatchMethod::kExact) << "as far away as they were last seen";
  EXPECT_EQ(result.matches.size(), 40U);
  EXPECT_EQ(look(0.1).method, MatchMethod::kGuided);
}

TEST_F(WidePriorTest, TracksComeFirstHereToo) {
  landmarks_.at(3).track_id = 77;
  builder_.lookFrom({0, 0, 0});
  const int other = builder_.addPixel(0, 0, kNoTrack, features_of_all_[3]);
  const int followed = builder_.addPixel(9, 0, 77, builder_.randomDescriptor());
  builder_.view().setPositionVariance(1, true);
  const auto result = matchLandmarks();
  ASSERT_EQ(result.method, MatchMethod::kExact);
  ASSERT_EQ(result.matches.size(), 1U) << "not to " << other << " as well";
  EXPECT_EQ(result.matches[0].target, 3);
  EXPECT_EQ(result.matches[0].feature, followed);
}

}  // namespace
}  // namespace ardrone_vslam
