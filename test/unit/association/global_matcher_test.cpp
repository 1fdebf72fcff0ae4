// SPDX-License-Identifier: BSD-3-Clause
#include "association/global_matcher.hpp"

#include <gtest/gtest.h>

#include "support/view_builder.hpp"

namespace ardrone_vslam {
namespace {

class GlobalMatcherTest : public ::testing::Test {
 protected:
  GlobalMatcherTest() {
    builder_.lookFrom({0, 0, 0});
    for (int i = 0; i < 400; ++i) addLandmark(builder_.randomDescriptor());
  }
  std::uint32_t addLandmark(const Descriptor& descriptor, std::int64_t last_seen_ns = 0) {
    Landmark landmark;
    landmark.last_seen_ns = last_seen_ns;
    landmark.descriptor = descriptor;
    return map_.add(landmark);
  }
  Descriptor descriptorOf(std::size_t landmark) const {
    return Descriptor(map_.all()[landmark].descriptor);
  }
  void addFeature(const Descriptor& descriptor) { builder_.addPixel(0, 0, 0, descriptor); }

  std::vector<DescriptorMatch> match(MatchMethod method, const std::vector<bool>& taken = {}) {
    std::vector<bool> marks = taken;
    marks.resize(builder_.features().size(), false);
    while (method == MatchMethod::kIndexed && !map_.advanceIndex()) continue;
    return GlobalMatcher(config_, index_probes_).match(builder_.features(), marks, map_, method);
  }
  /// Both methods, which must agree when all lists are probed.
  std::vector<DescriptorMatch> matchBoth(const std::vector<bool>& taken = {}) {
    const auto exact = match(MatchMethod::kExact, taken);
    const auto indexed = match(MatchMethod::kIndexed, taken);
    EXPECT_EQ(indexed.size(), exact.size());
    for (std::size_t i = 0; i < std::min(exact.size(), indexed.size()); ++i) {
      EXPECT_EQ(indexed[i].query, exact[i].query);
      EXPECT_EQ(indexed[i].train, exact[i].train);
      EXPECT_EQ(indexed[i].distance_bits, exact[i].distance_bits);
      EXPECT_EQ(indexed[i].second_distance_bits, exact[i].second_distance_bits);
    }
    return exact;
  }

  MatcherConfig config_;
  int index_probes_ = 1000;  // all lists
  test::ViewBuilder builder_;
  LandmarkMap map_{LandmarkMapConfig{}};
};

TEST_F(GlobalMatcherTest, FindsEachFeaturesLandmarkByEitherMethod) {
  for (const std::size_t i : {3U, 77U, 250U, 399U})
    addFeature(builder_.flipped(descriptorOf(i), 40));
  addFeature(builder_.randomDescriptor());
  const auto matches = matchBoth();
  ASSERT_EQ(matches.size(), 4U);
  EXPECT_EQ(matches[1].query, 1);
  EXPECT_EQ(matches[1].train, 77);
  EXPECT_EQ(matches[1].distance_bits, 40);
}

TEST_F(GlobalMatcherTest, TakenFeaturesAreLeftOut) {
  addFeature(descriptorOf(5));
  addFeature(descriptorOf(6));
  const auto matches = matchBoth({true, false});
  ASSERT_EQ(matches.size(), 1U);
  EXPECT_EQ(matches[0].query, 1);
  EXPECT_EQ(matches[0].train, 6);
  EXPECT_TRUE(matchBoth({true, true}).empty());
}

TEST_F(GlobalMatcherTest, LandmarksSeenSinceThenAreNoCandidates) {
  const Descriptor seen_again = builder_.randomDescriptor();
  addLandmark(seen_again, 8);
  addLandmark(descriptorOf(6), 8);  // hides its twin from the index alone
  addFeature(seen_again);
  addFeature(descriptorOf(6));
  addFeature(descriptorOf(9));
  GlobalMatcher matcher(config_, index_probes_);
  const std::vector<bool> none_taken(3, false);
  const auto exact = matcher.match(builder_.features(), none_taken, map_, MatchMethod::kExact, 8);
  ASSERT_EQ(exact.size(), 2U);
  EXPECT_EQ(exact[0].train, 6);
  EXPECT_EQ(exact[1].train, 9);
  while (!map_.advanceIndex()) continue;
  const auto indexed =
      matcher.match(builder_.features(), none_taken, map_, MatchMethod::kIndexed, 8);
  ASSERT_EQ(indexed.size(), 1U);
  EXPECT_EQ(indexed[0].train, 9);
}

TEST_F(GlobalMatcherTest, AmbiguousAndFarOnesAreNotMatches) {
  addFeature(builder_.flipped(descriptorOf(5), config_.max_hamming_bits + 1));
  addFeature(descriptorOf(6));
  addLandmark(descriptorOf(6));  // a twin
  EXPECT_TRUE(matchBoth().empty());
}

TEST_F(GlobalMatcherTest, CrossCheckKeepsTheNearestFeature) {
  addFeature(builder_.flipped(descriptorOf(5), 30));
  addFeature(builder_.flipped(descriptorOf(5), 20));
  const auto checked = matchBoth();
  ASSERT_EQ(checked.size(), 1U);
  EXPECT_EQ(checked[0].query, 1);
  config_.cross_check = false;
  EXPECT_EQ(matchBoth().size(), 2U);
}

TEST_F(GlobalMatcherTest, FollowsTheMapAsItChanges) {
  addFeature(descriptorOf(5));
  addFeature(builder_.randomDescriptor());
  EXPECT_EQ(matchBoth().size(), 1U);
  map_.at(7).descriptor = builder_.features().descriptor[1];  // seen anew
  EXPECT_EQ(matchBoth().size(), 2U);
  map_.remove(map_.all()[5].id);
  const auto matches = matchBoth();
  ASSERT_EQ(matches.size(), 1U);
  EXPECT_EQ(matches[0].train, 7);
  for (int round = 0; round < 3; ++round) {  // the last ones take the holes
    for (int i = 0; i < 100; ++i) map_.remove(map_.all()[20 + static_cast<std::size_t>(i)].id);
    for (int i = 0; i < 100; ++i) addLandmark(builder_.randomDescriptor());
    map_.at(390).descriptor = builder_.flipped(builder_.features().descriptor[0], round);
    EXPECT_EQ(matchBoth().size(), 2U) << round;
  }
}

TEST_F(GlobalMatcherTest, FewProbesFindFewerMatches) {
  for (int i = 0; i < 3600; ++i) addLandmark(builder_.randomDescriptor());
  for (std::size_t i = 0; i < 4000; i += 10) addFeature(builder_.flipped(descriptorOf(i), 80));
  const std::size_t with_all = match(MatchMethod::kIndexed).size();
  EXPECT_EQ(with_all, 400U);
  index_probes_ = 4;
  const std::size_t with_some = match(MatchMethod::kIndexed).size();
  index_probes_ = 1;
  const std::size_t with_one = match(MatchMethod::kIndexed).size();
  EXPECT_GT(with_one, 0U);
  EXPECT_LT(with_one, with_some);
  EXPECT_LT(with_some, with_all);
}

TEST_F(GlobalMatcherTest, EmptyMapsAndFramesMatchNothing) {
  EXPECT_TRUE(matchBoth().empty());
  map_ = LandmarkMap({});
  addFeature(builder_.randomDescriptor());
  EXPECT_TRUE(matchBoth().empty());
}

}  // namespace
}  // namespace ardrone_vslam
