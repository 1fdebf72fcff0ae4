// SPDX-License-Identifier: BSD-3-Clause
// The figures of the quality page against cases whose answers are known by hand.
#include "match_metrics.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace ardrone_vslam::quality {
namespace {

using Pixels = std::vector<Eigen::Vector2d>;

const Eigen::Vector2d kSize_px(400, 300);

/// Ten apart, well inside the border.
Pixels gridOfPixels(int columns, int rows) {
  Pixels pixels;
  for (int i = 0; i < columns * rows; ++i) {
    pixels.emplace_back(60 + 10 * (i % columns), 60 + 10 * (i / columns));
  }
  return pixels;
}

std::vector<IndexPair> eachWithItself(std::size_t count) {
  std::vector<IndexPair> matches;
  for (int i = 0; i < static_cast<int>(count); ++i) matches.emplace_back(i, i);
  return matches;
}

PairGeometry sameView() {
  return planeGeometry(Eigen::Matrix3d::Identity(), kSize_px, kSize_px);
}

Eigen::Matrix3d shiftedBy(double x_px, double y_px) {
  Eigen::Matrix3d H = Eigen::Matrix3d::Identity();
  H.topRightCorner<2, 1>() << x_px, y_px;
  return H;
}

Pixels mapped(const Pixels& pixels, const PixelMap& map) {
  Pixels result;
  for (const auto& pixel : pixels) result.push_back(map(pixel).value());
  return result;
}

TEST(MatchMetrics, IdenticalImagesRepeatWholly) {
  const Pixels pixels = gridOfPixels(6, 5);
  const PairMetrics metrics =
      PairTruth(pixels, pixels, sameView()).measure(eachWithItself(pixels.size()));
  EXPECT_EQ(metrics.features, 30);
  EXPECT_EQ(metrics.matches, 30);
  EXPECT_EQ(metrics.correct, 30);
  EXPECT_DOUBLE_EQ(metrics.repeatability, 1);
  EXPECT_DOUBLE_EQ(metrics.matching_score, 1);
  EXPECT_DOUBLE_EQ(metrics.precision, 1);
}

TEST(MatchMetrics, KnownHomographyIsFollowedBothWays) {
  Eigen::Matrix3d H;
  H << 0.9, -0.15, 40, 0.1, 1.1, -10, 2e-4, -1e-4, 1;
  for (const double sign : {1.0, -1.0, 3.0}) {  // a homography has no scale
    const PairGeometry geometry = planeGeometry(sign * H, kSize_px, kSize_px);
    const Pixels a = gridOfPixels(8, 6);
    const Pixels b = mapped(a, geometry.a_to_b);
    const Eigen::Vector2d expected = (H * Eigen::Vector3d(60, 60, 1)).hnormalized();
    EXPECT_LT((b[0] - expected).norm(), 1e-9);
    EXPECT_LT((geometry.b_to_a(b[0]).value() - a[0]).norm(), 1e-9);
    const PairMetrics metrics = PairTruth(a, b, geometry).measure(eachWithItself(a.size()));
    EXPECT_EQ(metrics.features, 48);
    EXPECT_DOUBLE_EQ(metrics.repeatability, 1);
    EXPECT_DOUBLE_EQ(metrics.matching_score, 1);
  }
}

TEST(MatchMetrics, PixelBeyondThePlanesHorizonHasNoCounterpart) {
  Eigen::Matrix3d H = Eigen::Matrix3d::Identity();
  H(2, 0) = -1.0 / 300;
  const PairGeometry geometry = planeGeometry(H, kSize_px, kSize_px);
  EXPECT_TRUE(geometry.a_to_b({299, 10}).has_value());
  EXPECT_FALSE(geometry.a_to_b({301, 10}).has_value());
}

TEST(MatchMetrics, SamePointWithinTwoPixels) {
  const Pixels a = {{100, 100}, {200, 100}};
  const Pixels b = {{102, 100}, {202.01, 100}};
  const PairTruth truth(a, b, sameView());
  EXPECT_TRUE(truth.isSamePoint(0, 0));
  EXPECT_FALSE(truth.isSamePoint(1, 1));
  EXPECT_FALSE(truth.isSamePoint(0, 1));
  EXPECT_EQ(truth.countRepeated(), 1);
}

TEST(MatchMetrics, DistanceIsTakenInTheCoarserImage) {
  const Eigen::Matrix3d enlarge = Eigen::Vector3d(2, 2, 1).asDiagonal();
  const PairGeometry geometry = planeGeometry(enlarge, kSize_px, 2 * kSize_px);
  const Pixels a = {{100, 100}};
  EXPECT_TRUE(PairTruth(a, {{203.9, 200}}, geometry).isSamePoint(0, 0));
  EXPECT_FALSE(PairTruth(a, {{204.1, 200}}, geometry).isSamePoint(0, 0));
  const PairGeometry back = planeGeometry(enlarge.inverse(), 2 * kSize_px, kSize_px);
  EXPECT_TRUE(PairTruth({{203.9, 200}}, a, back).isSamePoint(0, 0));
  EXPECT_FALSE(PairTruth({{204.1, 200}}, a, back).isSamePoint(0, 0));
}

TEST(MatchMetrics, EachFeatureRepeatsOnce) {
  const Pixels one = {{100, 100}};
  const Pixels cluster = {{99, 100}, {100, 101}, {101, 100}};
  const PairTruth truth(one, cluster, sameView());
  EXPECT_EQ(truth.countRepeated(), 1);
  EXPECT_DOUBLE_EQ(truth.measure({}).repeatability, 1);  // of the image with fewer features
}

TEST(MatchMetrics, AsManyPairsAsPossible) {
  // The first two of a and b are the nearest pair, but each other pair needs one of them.
  const Pixels a = {{100, 100}, {103, 100}};
  const Pixels b = {{101.4, 100}, {98.5, 100}};
  EXPECT_EQ(PairTruth(a, b, sameView()).countRepeated(), 2);
  EXPECT_EQ(PairTruth(b, a, sameView()).countRepeated(), 2);
  const Pixels chain_a = {{100, 100}, {103, 100}, {106, 100}, {109, 100}};
  const Pixels chain_b = {{101.5, 100}, {104.5, 100}, {107.5, 100}};
  EXPECT_EQ(PairTruth(chain_a, chain_b, sameView()).countRepeated(), 3);
}

TEST(MatchMetrics, NoFewerRepeatThanMatchCorrectly) {
  // Features of several scales upon each other, matched crosswise.
  const Pixels a = {{100, 100}, {101.5, 100}, {103, 100}};
  const Pixels b = {{101.6, 100}, {100, 100}, {104.9, 100}};
  const PairMetrics metrics = PairTruth(a, b, sameView()).measure(eachWithItself(3));
  EXPECT_EQ(metrics.correct, 3);
  EXPECT_DOUBLE_EQ(metrics.repeatability, 1);
}

TEST(MatchMetrics, OnlyTheCommonRegionCounts) {
  // The shift leaves the left half: columns 0..99 of image a are columns 200..299 of b.
  const PairGeometry geometry = planeGeometry(shiftedBy(200, 0), kSize_px, kSize_px);
  const Pixels a = {{100, 150}, {167, 150}, {168, 150}, {31, 150}, {32, 150}};
  const Pixels b = {{300, 150}, {367, 150}, {368, 150}, {231, 150}, {232, 150}, {100, 150}};
  const PairMetrics metrics = PairTruth(a, b, geometry).measure(eachWithItself(5));
  EXPECT_EQ(metrics.features, 3);  // 100, 167 and 32: 368 and 31 are too near to a border
  EXPECT_DOUBLE_EQ(metrics.repeatability, 1);
  EXPECT_DOUBLE_EQ(metrics.matching_score, 1);
  EXPECT_EQ(metrics.correct, 5);  // a match is right or wrong wherever it is
}

TEST(MatchMetrics, WrongMatchesLowerPrecisionAndScore) {
  const Pixels pixels = gridOfPixels(4, 1);
  const PairMetrics metrics =
      PairTruth(pixels, pixels, sameView()).measure({{0, 0}, {1, 2}, {2, 1}});
  EXPECT_EQ(metrics.matches, 3);
  EXPECT_EQ(metrics.correct, 1);
  EXPECT_DOUBLE_EQ(metrics.precision, 1.0 / 3);
  EXPECT_DOUBLE_EQ(metrics.matching_score, 1.0 / 4);
  EXPECT_DOUBLE_EQ(metrics.repeatability, 1);
}

TEST(MatchMetrics, NothingGivesZero) {
  const PairMetrics metrics = PairTruth({}, {}, sameView()).measure({});
  EXPECT_EQ(metrics.features, 0);
  EXPECT_EQ(metrics.repeatability, 0);
  EXPECT_EQ(metrics.precision, 0);
  EXPECT_EQ(meanOf({}).matches, 0);
}

TEST(MatchMetrics, MeanOfPairs) {
  PairMetrics first, second;
  first.features = 10;
  second.features = 13;
  first.repeatability = 0.5;
  second.repeatability = 1;
  second.precision = 0.25;
  const PairMetrics mean = meanOf({first, second});
  EXPECT_EQ(mean.features, 12);  // 11.5 rounded
  EXPECT_DOUBLE_EQ(mean.repeatability, 0.75);
  EXPECT_DOUBLE_EQ(mean.precision, 0.125);
}

}  // namespace
}  // namespace ardrone_vslam::quality
