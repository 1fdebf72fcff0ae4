// SPDX-License-Identifier: BSD-3-Clause
// Rendered images against the projection that they claim to follow.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <stdexcept>

#include "ardrone_vslam/camera_model.hpp"
#include "world_renderer.hpp"
#include "world_sequence.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kTexelsPerMetre = 250;
constexpr double kMarkRadius_m = 0.05;
constexpr double kMarkSpacing_m = 0.4;

/// White discs on black, the texels' coverage by 16 x 16 samples each; the first disc's middle is
/// half a spacing from both borders.
cv::Mat paintMarks(double width_m, double height_m) {
  cv::Mat picture(static_cast<int>(height_m * kTexelsPerMetre),
                  static_cast<int>(width_m * kTexelsPerMetre), CV_8UC1);
  constexpr int kSamples = 16;
  const auto distanceToMark = [](double metres) {
    return std::remainder(metres - kMarkSpacing_m / 2, kMarkSpacing_m);
  };
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < picture.cols; ++x) {
      const double from_border = std::hypot(distanceToMark((x + 0.5) / kTexelsPerMetre),
                                            distanceToMark((y + 0.5) / kTexelsPerMetre)) -
                                 kMarkRadius_m;
      if (std::abs(from_border) > 1 / kTexelsPerMetre) {
        picture.at<std::uint8_t>(y, x) = from_border < 0 ? 255 : 0;
        continue;
      }
      int inside = 0;
      for (int i = 0; i < kSamples * kSamples; ++i) {
        const double u = (x + (i % kSamples + 0.5) / kSamples) / kTexelsPerMetre;
        const double v = (y + (i / kSamples + 0.5) / kSamples) / kTexelsPerMetre;
        inside += std::hypot(distanceToMark(u), distanceToMark(v)) < kMarkRadius_m ? 1 : 0;
      }
      picture.at<std::uint8_t>(y, x) =
          static_cast<std::uint8_t>(std::lround(255.0 * inside / (kSamples * kSamples)));
    }
  }
  return picture;
}

/// A wall of marks at x = 3 m, seen by a camera that looks along x.
Surface markedWall() {
  static const auto texture = std::make_shared<MipTexture>(paintMarks(6, 4));
  return {{3, 3, 3.2}, {0, -1, 0}, {0, 0, -1}, 6, 4, kTexelsPerMetre, texture};
}

/// Brown's model, written anew.
Eigen::Vector2d project(const CameraIntrinsics& c, const Eigen::Vector3d& point_cam) {
  const double x = point_cam.x() / point_cam.z(), y = point_cam.y() / point_cam.z();
  const double r2 = x * x + y * y;
  const double radial = 1 + c.k1 * r2 + c.k2 * r2 * r2 + c.k3 * r2 * r2 * r2;
  return {c.cx_px + c.fx_px * (x * radial + 2 * c.p1 * x * y + c.p2 * (r2 + 2 * x * x)),
          c.cy_px + c.fy_px * (y * radial + c.p1 * (r2 + 2 * y * y) + 2 * c.p2 * x * y)};
}

/// Border of a mark in the image: [begin, end) around it and its centroid, by the polygon of 360
/// projected points (the centroid of a disc's image is not the image of its middle).
struct Outline {
  Eigen::Vector2d centroid;
  cv::Rect window;
};

std::optional<Outline> projectMark(const CameraIntrinsics& camera,
                                   const Eigen::Isometry3d& T_world_cam, const Surface& wall,
                                   const Eigen::Vector2d& middle_m) {
  constexpr int kPoints = 360;
  constexpr int kBlur_px = 3;
  std::vector<Eigen::Vector2d> polygon;
  Eigen::Vector2d low(1e9, 1e9), high(-1e9, -1e9);
  for (int i = 0; i < kPoints; ++i) {
    const double angle = 2 * M_PI * i / kPoints;
    const Eigen::Vector3d point_world =
        wall.corner + wall.right * (middle_m.x() + kMarkRadius_m * std::cos(angle)) +
        wall.down * (middle_m.y() + kMarkRadius_m * std::sin(angle));
    const Eigen::Vector3d point_cam = T_world_cam.inverse() * point_world;
    const Eigen::Vector2d plane = point_cam.head<2>() / point_cam.z();
    if (point_cam.z() < 0.2 || plane.norm() > 1) return std::nullopt;  // beyond the image
    polygon.push_back(project(camera, point_cam));
    low = low.cwiseMin(polygon.back());
    high = high.cwiseMax(polygon.back());
  }
  low.array() -= kBlur_px;
  high.array() += kBlur_px;
  if (low.minCoeff() < 0 || high.x() > camera.width_px - 1 || high.y() > camera.height_px - 1) {
    return std::nullopt;
  }
  double area = 0;
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < kPoints; ++i) {
    const Eigen::Vector2d a = polygon[i] - polygon[0];
    const Eigen::Vector2d b = polygon[(i + 1) % kPoints] - polygon[0];
    const double cross = a.x() * b.y() - a.y() * b.x();
    area += cross / 2;
    moment += (a + b) * cross / 6;
  }
  const cv::Point first(static_cast<int>(std::floor(low.x())),
                        static_cast<int>(std::floor(low.y())));
  const cv::Point last(static_cast<int>(std::ceil(high.x())),
                       static_cast<int>(std::ceil(high.y())));
  return Outline{polygon[0] + moment / area, cv::Rect(first, last + cv::Point(1, 1))};
}

Eigen::Vector2d centroidIn(const cv::Mat& image, const cv::Rect& window) {
  double sum = 0;
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  for (int y = window.y; y < window.y + window.height; ++y) {
    for (int x = window.x; x < window.x + window.width; ++x) {
      sum += image.at<std::uint8_t>(y, x);
      moment += image.at<std::uint8_t>(y, x) * Eigen::Vector2d(x, y);
    }
  }
  return moment / sum;
}

/// Compares all marks in sight. @return how many
int compareMarks(const CameraIntrinsics& camera, const Eigen::Isometry3d& T_world_cam) {
  const Scene scene{{markedWall()}};
  const cv::Mat image = WorldRenderer(camera, 0).render(scene, T_world_cam, 0);
  int compared = 0;
  Eigen::Vector2d error_sum = Eigen::Vector2d::Zero();
  for (int row = 0; row < 10; ++row) {
    for (int column = 0; column < 15; ++column) {
      const Eigen::Vector2d middle = kMarkSpacing_m * Eigen::Vector2d(column + 0.5, row + 0.5);
      const auto outline = projectMark(camera, T_world_cam, scene.surfaces[0], middle);
      if (!outline) continue;
      const Eigen::Vector2d found = centroidIn(image, outline->window);
      EXPECT_LT((found - outline->centroid).norm(), 0.05)
          << "mark " << column << ", " << row << " at " << outline->centroid.transpose()
          << ", found at " << found.transpose();
      error_sum += found - outline->centroid;
      ++compared;
    }
  }
  EXPECT_LT(error_sum.norm() / compared, 0.005) << "all marks are shifted";
  return compared;
}

Eigen::Isometry3d cameraAt(double x_m, double y_m, double z_m, double yaw_deg, double pitch_deg,
                           double roll_deg) {
  const auto turn = [](double angle_deg, const Eigen::Vector3d& axis) {
    return Eigen::AngleAxisd(angle_deg * M_PI / 180, axis);
  };
  return Eigen::Translation3d(x_m, y_m, z_m) * turn(yaw_deg, Eigen::Vector3d::UnitZ()) *
         turn(pitch_deg, Eigen::Vector3d::UnitY()) * turn(roll_deg, Eigen::Vector3d::UnitX()) *
         forwardCamera();
}

TEST(WorldRenderer, MarksLieWhereTheProjectionPutsThem) {
  const CameraIntrinsics camera = arDroneFrontCamera();
  EXPECT_GT(compareMarks(camera, cameraAt(0, 0, 1.2, 0, 0, 0)), 40);       // 3 m
  EXPECT_GT(compareMarks(camera, cameraAt(1.5, 0.3, 1.5, 10, 5, 20)), 8);  // 1.5 m
  EXPECT_GT(compareMarks(camera, cameraAt(1, 0.7, 1.1, 35, -5, -3)), 15);  // oblique
  EXPECT_GT(compareMarks(camera, cameraAt(-3, 0.1, 1.3, -3, 2, 90)), 60);  // 6 m
}

TEST(WorldRenderer, MarksLieRightForOtherLenses) {
  CameraIntrinsics camera = arDroneFrontCamera();
  camera.k1 = camera.k2 = 0;
  EXPECT_GT(compareMarks(camera, cameraAt(0, 0, 1.2, 0, 0, 0)), 30);
  camera.k1 = -0.3;
  camera.k2 = 0.1;
  camera.k3 = -0.01;
  camera.p1 = 0.003;
  camera.p2 = -0.004;
  camera.cx_px = 311.3;
  camera.cy_px = 187.8;
  camera.fy_px = 560;
  EXPECT_GT(compareMarks(camera, cameraAt(0, 0, 1.2, 5, 3, 2)), 30);
}

TEST(WorldRenderer, RaysInvertTheLensExactlyAndAgreeWithTheCameraModel) {
  const CameraIntrinsics camera = arDroneFrontCamera();
  const CameraModel model(camera);
  for (int row = 0; row < camera.height_px; row += 7) {
    for (int column = 0; column < camera.width_px; column += 7) {
      const Eigen::Vector2d pixel(column, row);
      Eigen::Vector3d ray;
      ASSERT_TRUE(exactDirection(camera, pixel, ray));
      EXPECT_LT((project(camera, ray) - pixel).norm(), 1e-8);
      const auto bearing = model.bearing(pixel);
      ASSERT_TRUE(bearing.has_value());
      EXPECT_LT((ray.normalized() - *bearing).norm(), 1e-8);
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

TEST(WorldRenderer, NoiseHasItsDeviationAndFollowsItsSeed) {
  Surface grey = markedWall();
  grey.texture = std::make_shared<MipTexture>(cv::Mat(100, 100, CV_8UC1, cv::Scalar(100)));
  const Scene scene{{grey}};
  const Eigen::Isometry3d T_world_cam = cameraAt(1.5, 0, 1.2, 0, 0, 0);
  const WorldRenderer renderer(arDroneFrontCamera(), 2);
  const cv::Mat image = renderer.render(scene, T_world_cam, 5);
  cv::Scalar mean, deviation;
  cv::meanStdDev(image, mean, deviation);
  EXPECT_NEAR(mean[0], 100, 0.1);
  EXPECT_NEAR(deviation[0], std::sqrt(4 + 1 / 12.0), 0.05);  // with the rounding's
  EXPECT_EQ(cv::norm(image, renderer.render(scene, T_world_cam, 5), cv::NORM_INF), 0);
  cv::Mat difference;
  cv::subtract(image, renderer.render(scene, T_world_cam, 6), difference, cv::noArray(), CV_32F);
  cv::meanStdDev(difference, mean, deviation);
  EXPECT_NEAR(deviation[0], std::sqrt(2 * (4 + 1 / 12.0)), 0.1);
}

}  // namespace
}  // namespace ardrone_vslam
