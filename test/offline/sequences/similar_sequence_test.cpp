// SPDX-License-Identifier: BSD-3-Clause
// A flight made into a similar one is as true as it was.
#include "sequences/similar_sequence.hpp"

#include <gtest/gtest.h>

#include "ardrone_vslam/camera_model.hpp"
#include "world/world_sequence.hpp"

namespace ardrone_vslam {
namespace {

std::unique_ptr<Sequence> laps() {
  WorldOptions options;
  options.duration_s = 2;
  options.rate_hz = 10;
  return std::make_unique<WorldSequence>(options);
}

/// Where a point of the map is seen in an image, by the truth.
Eigen::Vector2d pixelOf(const Sequence& sequence, std::size_t index, const Eigen::Vector3d& map_m) {
  const Eigen::Isometry3d T_map_cam =
      sequence.truth().at(sequence.stamp_ns(index)) * sequence.T_base_cam();
  return CameraModel(sequence.camera()).project(T_map_cam.inverse() * map_m).value();
}

TEST(SimilarSequence, SeesTheScaledSceneInTheSameImages) {
  const auto one = laps();
  const auto three = withSimilarity(laps(), {3, false});
  const std::size_t last = one->size() - 1;
  const Eigen::Vector3d ahead_m =
      one->truth().at(one->stamp_ns(last)) * Eigen::Vector3d(4, 0.3, -0.2);
  EXPECT_LT((pixelOf(*three, last, 3 * ahead_m) - pixelOf(*one, last, ahead_m)).norm(), 1e-6);
  EXPECT_EQ(three->stamp_ns(0), one->stamp_ns(0));
  EXPECT_EQ(three->stamp_ns(last) - three->stamp_ns(0),
            3 * (one->stamp_ns(last) - one->stamp_ns(0)));
  EXPECT_EQ(cv::norm(one->image(0), three->image(0), cv::NORM_INF), 0);
}

TEST(SimilarSequence, SeesTheMirroredSceneInMirroredImages) {
  const auto one = laps();
  const auto other = withSimilarity(laps(), {1, true});
  const std::size_t last = one->size() - 1;
  const Eigen::Vector3d ahead_m =
      one->truth().at(one->stamp_ns(last)) * Eigen::Vector3d(4, 0.3, -0.2);
  const Eigen::Vector2d seen_px = pixelOf(*one, last, ahead_m);
  const Eigen::Vector2d mirrored_px =
      pixelOf(*other, last, {ahead_m.x(), -ahead_m.y(), ahead_m.z()});
  EXPECT_NEAR(mirrored_px.x(), one->camera().width_px - 1 - seen_px.x(), 1e-6);
  EXPECT_NEAR(mirrored_px.y(), seen_px.y(), 1e-6);
  EXPECT_GT(std::abs(mirrored_px.x() - seen_px.x()), 1);
  EXPECT_GT(other->T_base_cam().linear().determinant(), 0.999);
  const cv::Mat image = one->image(0);
  EXPECT_EQ(other->image(0).at<std::uint8_t>(5, 7), image.at<std::uint8_t>(5, image.cols - 8));
}

}  // namespace
}  // namespace ardrone_vslam
