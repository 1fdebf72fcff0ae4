// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <vector>

#include "ardrone_vslam/camera_model.hpp"
#include "world_texture.hpp"

namespace ardrone_vslam {

/// A textured rectangle, seen from one side only. Facing it, `right` and `down` are the directions
/// of the picture's columns and rows and `corner` is its upper left corner [m, world].
struct Surface {
  Eigen::Vector3d corner;
  Eigen::Vector3d right;
  Eigen::Vector3d down;
  double width_m;
  double height_m;
  double texels_per_m;
  std::shared_ptr<const MipTexture> texture;
};

/// What there is to see. Rectangles may hide each other.
struct Scene {
  std::vector<Surface> surfaces;
};

/// Direction (x, y, 1) in the optical frame that Brown's model maps to the pixel; Newton's method
/// to 1e-12 of the image plane. @return false when there is none inside the model's fold
bool exactDirection(const CameraIntrinsics& camera, const Eigen::Vector2d& pixel_px,
                    Eigen::Vector3d& direction_cam);

/// Casts one exact ray per pixel; pixel (column, row) has its middle at these whole numbers.
/// 640x360 of a room takes about 10-20 ms on one core; rows are shared out among OpenCV's threads,
/// whose number does not change the result.
class WorldRenderer {
 public:
  /// @param noise_grey  deviation of the sensor's white noise
  /// @throws std::invalid_argument when the lens model folds back inside the image
  explicit WorldRenderer(const CameraIntrinsics& camera, double noise_grey = 2);

  /// 8-bit grey. Equal seeds give equal noise.
  cv::Mat render(const Scene& scene, const Eigen::Isometry3d& T_world_cam,
                 std::uint64_t noise_seed) const;

 private:
  struct Plane;

  void renderRow(int row, const std::vector<Plane>& planes, const Eigen::Matrix3f& R_world_cam,
                 std::uint8_t* pixels, std::uint64_t noise_seed) const;

  CameraIntrinsics camera_;
  std::vector<Eigen::Vector2f> rays_;  // (width + 1) x (height + 1): each pixel has a next one
  std::vector<float> noise_grey_;      // a supply of normal numbers
};

}  // namespace ardrone_vslam
