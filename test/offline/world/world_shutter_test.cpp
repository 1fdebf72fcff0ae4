// SPDX-License-Identifier: BSD-3-Clause
// Images of a camera that moves, and the tiles that rendering is cut into.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "sequences/drone_cameras.hpp"
#include "support/projected_marks.hpp"
#include "world/render/world_renderer.hpp"
#include "world/world.hpp"
#include "world/world_camera.hpp"

namespace ardrone_vslam {
namespace {

using namespace test;

TEST(WorldShutter, EachRowOfARollingShutterHasItsOwnPose) {
  const CameraIntrinsics camera = cameraNamed("front_wide").intrinsics;
  Exposure exposure;
  exposure.readout_s = 0.03;
  exposure.motion = [](double since_stamp_s) {  // 115 deg/s to the left and 1 m/s forwards
    return cameraAt(since_stamp_s, 0, 1.2, 115 * since_stamp_s, 0, 50 * since_stamp_s);
  };
  const auto poseOfRow = [&](double row) {
    return exposure.motion(((row + 0.5) / camera.height_px - 0.5) * exposure.readout_s);
  };
  const cv::Mat image = WorldRenderer(camera, 0).render(Scene{{markedWall()}}, exposure, 0);
  EXPECT_GT(compareMarks(camera, image, poseOfRow, markedWall()), 60);
  const cv::Mat still =
      WorldRenderer(camera, 0).render(Scene{{markedWall()}}, exposure.motion(0), 0);
  EXPECT_GT(cv::norm(image, still, cv::NORM_INF), 100);
}

/// Variance of the mark's light along the rows of the image [px^2].
double spreadAlongX(const cv::Mat& image, const cv::Rect& window) {
  const double middle = centroidIn(image, window).x();
  double sum = 0, spread = 0;
  for (int y = window.y; y < window.y + window.height; ++y) {
    for (int x = window.x; x < window.x + window.width; ++x) {
      sum += image.at<std::uint8_t>(y, x);
      spread += image.at<std::uint8_t>(y, x) * (x - middle) * (x - middle);
    }
  }
  return spread / sum;
}

TEST(WorldShutter, AnOpenShutterBlursByTheWayOfTheImage) {
  const CameraIntrinsics camera = arDroneFrontCamera();
  const WorldRenderer renderer(camera, 0);
  const Scene scene{{markedWall()}};
  constexpr double kRate_rad_s = 1.5;
  Exposure exposure;
  exposure.motion = [&](double since_stamp_s) {
    return cameraAt(0, -0.2, 1.4, kRate_rad_s * since_stamp_s * 180 / M_PI, 0, 0);
  };
  exposure.shutter_s = 0.012;
  const Eigen::Isometry3d middle = exposure.motion(0);
  // The mark before the camera, with room for its blur.
  const auto outline =
      projectMark(camera, [&](double) { return middle; }, scene.surfaces[0], {3.4, 1.8});
  ASSERT_TRUE(outline.has_value());
  const cv::Rect window = outline->window + cv::Size(16, 0) - cv::Point(8, 0);
  const cv::Mat sharp = renderer.render(scene, middle, 0);
  const cv::Mat blurred = renderer.render(scene, exposure, 0);
  const double blur_px = camera.fx_px * kRate_rad_s * exposure.shutter_s;
  EXPECT_NEAR(spreadAlongX(blurred, window) - spreadAlongX(sharp, window), blur_px * blur_px / 12,
              0.05 * blur_px * blur_px / 12);
  EXPECT_LT((centroidIn(blurred, window) - centroidIn(sharp, window)).norm(), 0.05);
}

/// Index of the nearest surface along the ray, by brute force.
int surfaceAlong(const Scene& scene, const Eigen::Vector3d& from, const Eigen::Vector3d& ray) {
  int nearest = -1;
  double nearest_length = 1e9;
  for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
    const auto length = rangeAlong(Scene{{scene.surfaces[i]}}, from, ray);
    if (!length || *length >= nearest_length) continue;
    nearest_length = *length;
    nearest = static_cast<int>(i);
  }
  return nearest;
}

TEST(WorldShutter, TilesLeaveOutNothingThatIsSeen) {
  Scene scene = makeWorld("moving", "steady", 2).at(7);
  ASSERT_LT(scene.surfaces.size(), 255U);
  for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
    scene.surfaces[i].texture =
        std::make_shared<MipTexture>(cv::Mat(64, 64, CV_8UC1, cv::Scalar(static_cast<double>(i))));
    scene.surfaces[i].grain = nullptr;
  }
  const CameraIntrinsics camera = cameraNamed("front_wide").intrinsics;
  const WorldRenderer renderer(camera, 0);
  int checked = 0, seen_surfaces = 0;
  for (int view = 0; view < 8; ++view) {
    const Eigen::Isometry3d T_world_cam =
        cameraAt(2 - 0.5 * view, 0.3 * view - 1, 0.9 + 0.2 * view, 50 * view, 10 * view - 20, view);
    const cv::Mat image = renderer.render(scene, T_world_cam, 0);
    std::vector<bool> seen(scene.surfaces.size());
    for (int row = 3; row < camera.height_px - 1; row += 9) {
      for (int column = 3; column < camera.width_px - 1; column += 9) {
        const cv::Mat around = image(cv::Rect(column - 1, row - 1, 3, 3));
        const int shown = image.at<std::uint8_t>(row, column);
        if (cv::countNonZero(around != shown) > 0) continue;  // an edge
        Eigen::Vector3d ray;
        ASSERT_TRUE(exactDirection(camera, {column, row}, ray));
        ASSERT_EQ(surfaceAlong(scene, T_world_cam.translation(), T_world_cam.linear() * ray), shown)
            << "view " << view << ", pixel " << column << ", " << row;
        seen[static_cast<std::size_t>(shown)] = true;
        ++checked;
      }
    }
    seen_surfaces += static_cast<int>(std::count(seen.begin(), seen.end(), true));
    // And row by row.
    Exposure exposure;
    exposure.motion = [&](double) { return T_world_cam; };
    exposure.readout_s = exposure.shutter_s = 0.02;
    EXPECT_EQ(cv::norm(image, renderer.render(scene, exposure, 0), cv::NORM_INF), 0);
  }
  EXPECT_GT(checked, 15000);
  EXPECT_GT(seen_surfaces, 80);
}

}  // namespace
}  // namespace ardrone_vslam
