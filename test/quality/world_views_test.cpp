// SPDX-License-Identifier: BSD-3-Clause
// Which pixels of two views of the synthetic room show the same.
#include "world_views.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "world/world_sequence.hpp"

namespace ardrone_vslam::quality {
namespace {

/// A wall at x = 3 m and, half as far, a narrow screen that hides its middle.
Scene wallBehindScreen() {
  const Eigen::Vector3d right(0, -1, 0), down(0, 0, -1);
  Scene scene;
  scene.surfaces.push_back({{3, 3, 3}, right, down, 6, 6, 250, nullptr});
  scene.surfaces.push_back({{1.5, 0.1, 3}, right, down, 0.2, 6, 250, nullptr});
  return scene;
}

TEST(WorldViews, PointSeenIsOnTheNearestSurface) {
  const Scene scene = wallBehindScreen();
  const CameraModel camera(arDroneFrontCamera());
  const auto pose = lookAlong(0, {0, 0, 0});
  const auto middle = pointSeen(scene, camera, pose, {320, 180});
  ASSERT_TRUE(middle);
  EXPECT_LT((*middle - Eigen::Vector3d(1.5, 0, 0)).norm(), 1e-9);
  const auto beside = pointSeen(scene, camera, pose, {500, 180});
  ASSERT_TRUE(beside);
  EXPECT_NEAR(beside->x(), 3, 1e-9);
  EXPECT_LT(beside->y(), -0.9);  // the right of the image is the world's -y
  EXPECT_FALSE(pointSeen(scene, camera, lookAlong(M_PI, {0, 0, 0}), {320, 180}));
}

TEST(WorldViews, TransferFollowsTheProjection) {
  const Scene scene = wallBehindScreen();
  const CameraModel camera(arDroneFrontCamera());
  const auto from = lookAlong(0, {0, 0, 0}), to = lookAlong(0.1, {0.2, -0.3, 0.1});
  const Eigen::Vector3d point(3, -0.8, 0.4);
  const Eigen::Vector2d from_px = camera.project(from.inverse() * point).value();
  const Eigen::Vector2d to_px = camera.project(to.inverse() * point).value();
  const auto moved = transferPixel(scene, camera, from, to, from_px);
  ASSERT_TRUE(moved);
  EXPECT_LT((*moved - to_px).norm(), 1e-5);
  const auto back = transferPixel(scene, camera, to, from, to_px);
  ASSERT_TRUE(back);
  EXPECT_LT((*back - from_px).norm(), 1e-5);
}

TEST(WorldViews, HiddenPointHasNoCounterpart) {
  const Scene scene = wallBehindScreen();
  const CameraModel camera(arDroneFrontCamera());
  const auto middle = lookAlong(0, {0, 0, 0});
  const auto beside = lookAlong(0, {0, 0.5, 0});
  const Eigen::Vector3d behind_screen(3, 0, 0);
  const Eigen::Vector2d seen_px = camera.project(beside.inverse() * behind_screen).value();
  ASSERT_LT((pointSeen(scene, camera, beside, seen_px).value() - behind_screen).norm(), 1e-6);
  EXPECT_FALSE(transferPixel(scene, camera, beside, middle, seen_px));
}

/// The rendered images themselves obey the transfer: what a pixel shows, its counterpart shows.
TEST(WorldViews, RenderedViewsAgreeWithTheTransfer) {
  CameraIntrinsics intrinsics = arDroneFrontCamera();
  const WorldViews world(intrinsics);
  const auto a = lookAlong(0.4, {0, 0, 1.4}), b = lookAlong(0.5, {0.2, 0.1, 1.5});
  const cv::Mat image_a = world.render(a, 1), image_b = world.render(b, 2);
  const PairGeometry geometry = world.geometry(a, b);
  const auto meanDifference = [&](double shift_px) {
    double sum = 0;
    int count = 0;
    for (int y = 40; y < 320; y += 4) {
      for (int x = 40; x < 600; x += 4) {
        const auto other = geometry.a_to_b(Eigen::Vector2d(x, y));
        if (!other) continue;
        const int column = static_cast<int>(std::lround(other->x() + shift_px));
        const int row = static_cast<int>(std::lround(other->y()));
        if (column < 0 || row < 0 || column >= image_b.cols || row >= image_b.rows) continue;
        sum += std::abs(image_a.at<std::uint8_t>(y, x) - image_b.at<std::uint8_t>(row, column));
        ++count;
      }
    }
    EXPECT_GT(count, 2000);
    return sum / count;
  };
  EXPECT_LT(meanDifference(0), 0.5 * meanDifference(6));
  EXPECT_LT(meanDifference(0), meanDifference(1));
  EXPECT_LT(meanDifference(0), meanDifference(-1));
}

}  // namespace
}  // namespace ardrone_vslam::quality
