// SPDX-License-Identifier: BSD-3-Clause
// Marks on a wall or floor, and where an image must show them.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "ardrone_vslam/camera_model.hpp"
#include "sequences/sequence.hpp"
#include "world/scene/world_scene.hpp"

namespace ardrone_vslam::test {

constexpr double kTexelsPerMetre = 250;
constexpr double kMarkRadius_m = 0.05;
constexpr double kMarkSpacing_m = 0.4;

/// From the next disc's middle.
inline double distanceToMark_m(double u_m, double v_m) {
  const auto along = [](double metres) {
    return std::remainder(metres - kMarkSpacing_m / 2, kMarkSpacing_m);
  };
  return std::hypot(along(u_m), along(v_m));
}

/// By 16 x 16 samples of the texel.
inline std::uint8_t greyOfMarks(int x, int y) {
  constexpr int kSamples = 16;
  const double from_border =
      distanceToMark_m((x + 0.5) / kTexelsPerMetre, (y + 0.5) / kTexelsPerMetre) - kMarkRadius_m;
  if (std::abs(from_border) > 1 / kTexelsPerMetre) return from_border < 0 ? 255 : 0;
  int inside = 0;
  for (int i = 0; i < kSamples * kSamples; ++i) {
    const double u = (x + (i % kSamples + 0.5) / kSamples) / kTexelsPerMetre;
    const double v = (y + (i / kSamples + 0.5) / kSamples) / kTexelsPerMetre;
    inside += distanceToMark_m(u, v) < kMarkRadius_m ? 1 : 0;
  }
  return static_cast<std::uint8_t>(std::lround(255.0 * inside / (kSamples * kSamples)));
}

/// White discs on black; the first disc's middle is half a spacing from both borders.
inline cv::Mat paintMarks(double width_m, double height_m) {
  cv::Mat picture(static_cast<int>(height_m * kTexelsPerMetre),
                  static_cast<int>(width_m * kTexelsPerMetre), CV_8UC1);
  for (int y = 0; y < picture.rows; ++y)
    for (int x = 0; x < picture.cols; ++x) picture.at<std::uint8_t>(y, x) = greyOfMarks(x, y);
  return picture;
}

/// A wall of marks at x = 3 m, seen by a camera that looks along x.
inline Surface markedWall() {
  static const auto texture = std::make_shared<MipTexture>(paintMarks(6, 4));
  return {{3, 3, 3.2}, {0, -1, 0}, {0, 0, -1}, 6, 4, kTexelsPerMetre, texture};
}

/// Brown's model, written anew.
inline Eigen::Vector2d project(const CameraIntrinsics& c, const Eigen::Vector3d& point_cam) {
  const double x = point_cam.x() / point_cam.z(), y = point_cam.y() / point_cam.z();
  const double r2 = x * x + y * y;
  const double radial = 1 + c.k1 * r2 + c.k2 * r2 * r2 + c.k3 * r2 * r2 * r2;
  return {c.cx_px + c.fx_px * (x * radial + 2 * c.p1 * x * y + c.p2 * (r2 + 2 * x * x)),
          c.cy_px + c.fy_px * (y * radial + c.p1 * (r2 + 2 * y * y) + 2 * c.p2 * x * y)};
}

/// T_world_cam while a row is exposed.
using PoseOfRow = std::function<Eigen::Isometry3d(double row)>;

/// Where the point appears, in the row that is exposed when the camera sees it there; nothing far
/// outside of the image.
inline std::optional<Eigen::Vector2d> pixelOf(const CameraIntrinsics& camera, const PoseOfRow& pose,
                                              const Eigen::Vector3d& point_world) {
  Eigen::Vector2d pixel(camera.cx_px, camera.cy_px);
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d point_cam = pose(pixel.y()).inverse() * point_world;
    if (point_cam.z() < 0.2 || (point_cam.head<2>() / point_cam.z()).norm() > 1.1) {
      return std::nullopt;
    }
    pixel = project(camera, point_cam);
  }
  return pixel;
}

/// Border of a mark in the image: [begin, end) around it and its centroid, by the polygon of 360
/// projected points (the centroid of a disc's image is not the image of its middle).
struct Outline {
  Eigen::Vector2d centroid;
  cv::Rect window;
};

inline std::optional<Outline> projectMark(const CameraIntrinsics& camera, const PoseOfRow& pose,
                                          const Surface& wall, const Eigen::Vector2d& middle_m) {
  constexpr int kPoints = 360;
  constexpr int kBlur_px = 3;
  std::vector<Eigen::Vector2d> polygon;
  Eigen::Vector2d low(1e9, 1e9), high(-1e9, -1e9);
  for (int i = 0; i < kPoints; ++i) {
    const double angle = 2 * M_PI * i / kPoints;
    const Eigen::Vector3d point_world =
        wall.corner + wall.right * (middle_m.x() + kMarkRadius_m * std::cos(angle)) +
        wall.down * (middle_m.y() + kMarkRadius_m * std::sin(angle));
    const auto pixel = pixelOf(camera, pose, point_world);
    if (!pixel) return std::nullopt;
    polygon.push_back(*pixel);
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

inline Eigen::Vector2d centroidIn(const cv::Mat& image, const cv::Rect& window) {
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
inline int compareMarks(const CameraIntrinsics& camera, const cv::Mat& image, const PoseOfRow& pose,
                        const Surface& wall) {
  int compared = 0;
  Eigen::Vector2d error_sum = Eigen::Vector2d::Zero();
  for (int row = 0; row < 10; ++row) {
    for (int column = 0; column < 15; ++column) {
      const Eigen::Vector2d middle = kMarkSpacing_m * Eigen::Vector2d(column + 0.5, row + 0.5);
      const auto outline = projectMark(camera, pose, wall, middle);
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

inline Eigen::Isometry3d cameraAt(double x_m, double y_m, double z_m, double yaw_deg,
                                  double pitch_deg, double roll_deg) {
  const auto turn = [](double angle_deg, const Eigen::Vector3d& axis) {
    return Eigen::AngleAxisd(angle_deg * M_PI / 180, axis);
  };
  return Eigen::Translation3d(x_m, y_m, z_m) * turn(yaw_deg, Eigen::Vector3d::UnitZ()) *
         turn(pitch_deg, Eigen::Vector3d::UnitY()) * turn(roll_deg, Eigen::Vector3d::UnitX()) *
         forwardCamera();
}

/// The same marks on the floor.
inline Surface markedFloor() {
  Surface floor = markedWall();
  floor.corner = {2, 3, 0};
  floor.right = {0, -1, 0};
  floor.down = {-1, 0, 0};
  return floor;
}

}  // namespace ardrone_vslam::test
