// SPDX-License-Identifier: BSD-3-Clause
#include "alignment/view_change.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "support/grey_images.hpp"

namespace ardrone_vslam {
namespace {

/// Tracks all over an image that turns and grows, on whole pixels.
std::vector<TrackMove> movesOf(float rotation_rad, float growth, int tracks, int wrong) {
  std::mt19937 random(5);
  const Eigen::Matrix2f change = growth * Eigen::Rotation2Df(rotation_rad).toRotationMatrix();
  const auto anywhere_px = [&random] {
    return Eigen::Vector2f(static_cast<float>(test::uniformInt(random, 24, 615)),
                           static_cast<float>(test::uniformInt(random, 24, 335)));
  };
  std::vector<TrackMove> moves;
  for (int i = 0; i < tracks; ++i) {
    const Eigen::Vector2f before_px = anywhere_px();
    const Eigen::Vector2f now_px = change * before_px + Eigen::Vector2f(31, -17);
    const Eigen::Vector2f wrong_px = before_px + (anywhere_px() - before_px) / 8;
    moves.push_back({complexOf(before_px),
                     complexOf(i < wrong ? wrong_px : now_px.array().round().matrix().eval())});
  }
  return moves;
}

void expectChange(const ViewChange& change, float rotation_rad, float growth, float error) {
  EXPECT_NEAR(change.real(), growth * std::cos(rotation_rad), error);
  EXPECT_NEAR(change.imag(), growth * std::sin(rotation_rad), error);
}

TEST(CommonViewChange, IsTheSimilarityThatMovedTheTracks) {
  for (const float rotation_rad : {-0.3F, 0.F, 0.05F})
    for (const float growth : {0.8F, 1.F, 1.2F})
      expectChange(commonViewChange(movesOf(rotation_rad, growth, 300, 0)), rotation_rad, growth,
                   4e-4F);
}

TEST(CommonViewChange, WrongMatchesHardlyCount) {
  expectChange(commonViewChange(movesOf(0.06F, 1.02F, 300, 100)), 0.06F, 1.02F, 3e-3F);
}

TEST(CommonViewChange, IsNoneWhereTooLittleTellsIt) {
  expectChange(commonViewChange({}), 0, 1, 0);
  expectChange(commonViewChange(movesOf(0.1F, 1, 7, 0)), 0, 1, 0);
  expectChange(commonViewChange(std::vector<TrackMove>(50, {{40, 40}, {50, 60}})), 0, 1, 0);
  expectChange(commonViewChange(movesOf(2, 1, 300, 0)), 0, 1, 0);  // not between two images
}

}  // namespace
}  // namespace ardrone_vslam
