// SPDX-License-Identifier: BSD-3-Clause
// Rendered images against the projection that they claim to follow.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "ardrone_vslam/camera_model.hpp"
#include "sequences/drone_cameras.hpp"
#include "support/projected_marks.hpp"
#include "world/render/world_renderer.hpp"
#include "world/world_camera.hpp"

namespace ardrone_vslam {
namespace {

using namespace test;

int compareMarksAt(const CameraIntrinsics& camera, const Eigen::Isometry3d& T_world_cam,
                   const Surface& wall = markedWall()) {
  const cv::Mat image = WorldRenderer(camera, 0).render(Scene{{wall}}, T_world_cam, 0);
  return test::compareMarks(
      camera, image, [&](double) { return T_world_cam; }, wall);
}

TEST(WorldRenderer, MarksLieWhereTheProjectionPutsThem) {
  const CameraIntrinsics camera = arDroneFrontCamera();
  EXPECT_GT(compareMarksAt(camera, cameraAt(0, 0, 1.2, 0, 0, 0)), 40);       // 3 m
  EXPECT_GT(compareMarksAt(camera, cameraAt(1.5, 0.3, 1.5, 10, 5, 20)), 8);  // 1.5 m
  EXPECT_GT(compareMarksAt(camera, cameraAt(1, 0.7, 1.1, 35, -5, -3)), 15);  // oblique
  EXPECT_GT(compareMarksAt(camera, cameraAt(-3, 0.1, 1.3, -3, 2, 90)), 60);  // 6 m
}

TEST(WorldRenderer, MarksLieRightForOtherLenses) {
  CameraIntrinsics camera = arDroneFrontCamera();
  camera.k1 = camera.k2 = 0;
  EXPECT_GT(compareMarksAt(camera, cameraAt(0, 0, 1.2, 0, 0, 0)), 30);
  camera.k1 = -0.3;
  camera.k2 = 0.1;
  camera.k3 = -0.01;
  camera.p1 = 0.003;
  camera.p2 = -0.004;
  camera.cx_px = 311.3;
  camera.cy_px = 187.8;
  camera.fy_px = 560;
  EXPECT_GT(compareMarksAt(camera, cameraAt(0, 0, 1.2, 5, 3, 2)), 30);
}

Eigen::Isometry3d bodyAt(const Eigen::Vector3d& place, double yaw_deg, double tilt_deg) {
  return Eigen::Translation3d(place) *
         Eigen::AngleAxisd(yaw_deg * M_PI / 180, Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(tilt_deg * M_PI / 180, Eigen::Vector3d(0.6, 0.8, 0));
}

TEST(WorldRenderer, MarksLieRightForTheDronesOtherCameras) {
  EXPECT_GT(compareMarksAt(cameraNamed("front_wide").intrinsics, cameraAt(0, 0, 1.2, 3, 2, 5)), 60);
  const CameraChoice& bottom = cameraNamed("bottom");
  const auto marksFrom = [&](const Eigen::Isometry3d& T_world_body) {
    return compareMarksAt(bottom.intrinsics, T_world_body * bottom.T_body_cam, markedFloor());
  };
  EXPECT_GE(marksFrom(bodyAt({0.2, 0.2, 0.5}, 0, 0)), 1);
  EXPECT_GT(marksFrom(bodyAt({0, 0, 1.6}, 30, 5)), 5);
  EXPECT_GT(marksFrom(bodyAt({0.1, -0.2, 2.5}, 200, 10)), 20);
}

TEST(WorldRenderer, RaysInvertTheLensExactlyAndAgreeWithTheCameraModel) {
  for (const CameraChoice& choice : cameras()) {
    const CameraIntrinsics& camera = choice.intrinsics;
    const CameraModel model(camera);
    for (int row = 0; row < camera.height_px; row += 7) {
      for (int column = 0; column < camera.width_px; column += 7) {
        const Eigen::Vector2d pixel(column, row);
        Eigen::Vector3d ray;
        ASSERT_TRUE(exactDirection(camera, pixel, ray)) << choice.name;
        EXPECT_LT((project(camera, ray) - pixel).norm(), 1e-8);
        const auto bearing = model.bearing(pixel);
        const auto projected = model.project(ray);
        ASSERT_TRUE(bearing.has_value() && projected.has_value()) << choice.name;
        EXPECT_LT((ray.normalized() - *bearing).norm(), 1e-8);
        EXPECT_LT((*projected - pixel).norm(), 1e-8);
      }
    }
  }
}

TEST(WorldRenderer, RefusesALensThatFoldsInsideTheImage) {
  CameraIntrinsics camera = arDroneFrontCamera();
  camera.k2 = 0;
  EXPECT_THROW(WorldRenderer{camera}, std::invalid_argument);
}

TEST(WorldRenderer, NearerSurfacesHideFartherOnes) {
  Surface near = markedWall();
  near.corner = {1, 0.2, 1.4};
  near.width_m = near.height_m = 0.4;
  near.texture = std::make_shared<MipTexture>(cv::Mat(100, 100, CV_8UC1, cv::Scalar(77)));
  const WorldRenderer renderer(arDroneFrontCamera(), 0);
  for (const Scene& scene : {Scene{{markedWall(), near}}, Scene{{near, markedWall()}}}) {
    const cv::Mat image = renderer.render(scene, cameraAt(0, 0, 1.2, 0, 0, 0), 0);
    EXPECT_EQ(image.at<std::uint8_t>(180, 320), 77);
    EXPECT_EQ(image.at<std::uint8_t>(120, 260), 77);
    EXPECT_NE(image.at<std::uint8_t>(20, 320), 77);
  }
}

TEST(WorldRenderer, NoiseHasItsSigmaAndFollowsItsSeed) {
  Surface grey = markedWall();
  grey.texture = std::make_shared<MipTexture>(cv::Mat(100, 100, CV_8UC1, cv::Scalar(100)));
  const Scene scene{{grey}};
  const Eigen::Isometry3d T_world_cam = cameraAt(1.5, 0, 1.2, 0, 0, 0);
  const WorldRenderer renderer(arDroneFrontCamera(), 2);
  const cv::Mat image = renderer.render(scene, T_world_cam, 5);
  cv::Scalar mean, sigma;
  cv::meanStdDev(image, mean, sigma);
  EXPECT_NEAR(mean[0], 100, 0.1);
  EXPECT_NEAR(sigma[0], std::sqrt(4 + 1 / 12.0), 0.05);  // with the rounding's
  EXPECT_EQ(cv::norm(image, renderer.render(scene, T_world_cam, 5), cv::NORM_INF), 0);
  cv::Mat difference;
  cv::subtract(image, renderer.render(scene, T_world_cam, 6), difference, cv::noArray(), CV_32F);
  cv::meanStdDev(difference, mean, sigma);
  EXPECT_NEAR(sigma[0], std::sqrt(2 * (4 + 1 / 12.0)), 0.1);
}

}  // namespace
}  // namespace ardrone_vslam
