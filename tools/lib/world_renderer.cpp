// SPDX-License-Identifier: BSD-3-Clause
#include "world_renderer.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "random_source.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::size_t kNoiseSupply = 1 << 14;
constexpr float kEdgeTolerance_m = 1e-4F;  // rays along an edge must meet one of its two sides

/// Brown's model and its Jacobian on the image plane.
Eigen::Vector2d distort(const CameraIntrinsics& c, const Eigen::Vector2d& p, Eigen::Matrix2d& J) {
  const double x = p.x(), y = p.y();
  const double r2 = p.squaredNorm();
  const double radial = 1 + r2 * (c.k1 + r2 * (c.k2 + r2 * c.k3));
  const double slope = c.k1 + r2 * (2 * c.k2 + r2 * 3 * c.k3);  // d radial / d r2
  J << radial + 2 * x * x * slope + 2 * c.p1 * y + 6 * c.p2 * x,
      2 * x * y * slope + 2 * c.p1 * x + 2 * c.p2 * y,
      2 * x * y * slope + 2 * c.p1 * x + 2 * c.p2 * y,
      radial + 2 * y * y * slope + 6 * c.p1 * y + 2 * c.p2 * x;
  return {x * radial + 2 * c.p1 * x * y + c.p2 * (r2 + 2 * x * x),
          y * radial + c.p1 * (r2 + 2 * y * y) + 2 * c.p2 * x * y};
}

}  // namespace

bool exactDirection(const CameraIntrinsics& camera, const Eigen::Vector2d& pixel_px,
                    Eigen::Vector3d& direction_cam) {
  const Eigen::Vector2d distorted((pixel_px.x() - camera.cx_px) / camera.fx_px,
                                  (pixel_px.y() - camera.cy_px) / camera.fy_px);
  // From the middle outwards: the solution is followed continuously and cannot leap over the fold.
  constexpr int kStages = 8;
  Eigen::Vector2d plane = Eigen::Vector2d::Zero();
  Eigen::Matrix2d J;
  for (int stage = 1; stage <= kStages; ++stage) {
    const Eigen::Vector2d target = distorted * (static_cast<double>(stage) / kStages);
    double error = 1;
    for (int iteration = 0; iteration < 20 && error > 1e-13; ++iteration) {
      const Eigen::Vector2d residual = distort(camera, plane, J) - target;
      error = residual.norm();
      if (!(J.determinant() > 0)) return false;
      plane -= J.inverse() * residual;
    }
    if (!(error < 1e-12)) return false;
  }
  direction_cam << plane, 1;
  return true;
}

/// A surface as the camera of one frame sees it: floats relative to the camera's position.
struct WorldRenderer::Plane {
  Plane(const Surface& surface, const Eigen::Vector3d& camera_position)
      : right(surface.right.cast<float>()),
        down(surface.down.cast<float>()),
        width_m(static_cast<float>(surface.width_m)),
        height_m(static_cast<float>(surface.height_m)),
        texels_per_m(static_cast<float>(surface.texels_per_m)),
        texture(surface.texture.get()) {
    const Eigen::Vector3d to_corner = surface.corner - camera_position;
    const Eigen::Vector3d away = surface.right.cross(surface.down);
    distance_m = away.dot(to_corner);
    over_distance = (away / distance_m).cast<float>();
    offset_right_m = static_cast<float>(-surface.right.dot(to_corner));
    offset_down_m = static_cast<float>(-surface.down.dot(to_corner));
  }

  bool isFacing() const { return distance_m > 1e-6; }

  double distance_m = 0;          // of the plane from the camera
  Eigen::Vector3f over_distance;  // with a ray: the reciprocal of the ray's length to the plane
  Eigen::Vector3f right;
  Eigen::Vector3f down;
  float offset_right_m = 0;  // of the camera's foot from the corner
  float offset_down_m = 0;
  float width_m;
  float height_m;
  float texels_per_m;
  const MipTexture* texture;

  /// Position on the surface of the ray's hit at this length.
  Eigen::Vector2f hit(const Eigen::Vector3f& ray, float length) const {
    return {offset_right_m + length * right.dot(ray), offset_down_m + length * down.dot(ray)};
  }
  bool contains(const Eigen::Vector2f& at) const {
    return at.x() >= -kEdgeTolerance_m && at.x() <= width_m + kEdgeTolerance_m &&
           at.y() >= -kEdgeTolerance_m && at.y() <= height_m + kEdgeTolerance_m;
  }
  /// How far the hit moves when the ray changes by `change`.
  Eigen::Vector2f step(const Eigen::Vector3f& ray, const Eigen::Vector3f& change,
                       float length) const {
    // d(length) = -length^2 d(1 / length)
    const Eigen::Vector3f move = length * (change - ray * (length * over_distance.dot(change)));
    return {right.dot(move), down.dot(move)};
  }
};

WorldRenderer::WorldRenderer(const CameraIntrinsics& camera, double noise_grey) : camera_(camera) {
  for (int row = 0; row <= camera.height_px; ++row) {
    for (int column = 0; column <= camera.width_px; ++column) {
      Eigen::Vector3d direction;
      if (!exactDirection(camera, {column, row}, direction)) {
        throw std::invalid_argument(
            "the camera's distortion folds back inside the image at pixel (" +
            std::to_string(column) + ", " + std::to_string(row) +
            "); give the coefficients of a real lens");
      }
      rays_.push_back(direction.head<2>().cast<float>());
    }
  }
  RandomSource random(0);
  for (std::size_t i = 0; i < kNoiseSupply; ++i) {
    noise_grey_.push_back(static_cast<float>(noise_grey * random.normal()));
  }
}

cv::Mat WorldRenderer::render(const Scene& scene, const Eigen::Isometry3d& T_world_cam,
                              std::uint64_t noise_seed) const {
  std::vector<Plane> planes;
  for (const auto& surface : scene.surfaces) {
    const Plane plane(surface, T_world_cam.translation());
    if (plane.isFacing()) planes.push_back(plane);
  }
  cv::Mat image(camera_.height_px, camera_.width_px, CV_8UC1);
  const Eigen::Matrix3f R_world_cam = T_world_cam.linear().cast<float>();
  cv::parallel_for_(cv::Range(0, image.rows), [&](const cv::Range& rows) {
    for (int row = rows.start; row < rows.end; ++row) {
      const std::uint64_t row_seed =
          RandomSource::mix(RandomSource::mix(noise_seed) + static_cast<std::uint64_t>(row));
      renderRow(row, planes, R_world_cam, image.ptr<std::uint8_t>(row), row_seed);
    }
  });
  return image;
}

void WorldRenderer::renderRow(int row, const std::vector<Plane>& planes,
                              const Eigen::Matrix3f& R_world_cam, std::uint8_t* pixels,
                              std::uint64_t noise_seed) const {
  const auto width = static_cast<std::size_t>(camera_.width_px);
  const Eigen::Vector2f* rays = rays_.data() + static_cast<std::size_t>(row) * (width + 1);
  const Eigen::Vector2f* rays_below = rays + width + 1;
  Eigen::Vector3f next = R_world_cam * rays[0].homogeneous();
  for (std::size_t column = 0; column < width; ++column) {
    const Eigen::Vector3f ray = next;
    next = R_world_cam * rays[column + 1].homogeneous();
    const Plane* nearest = nullptr;
    float nearest_over_length = 0;
    Eigen::Vector2f at;
    for (const auto& plane : planes) {
      const float over_length = plane.over_distance.dot(ray);
      if (over_length <= nearest_over_length) continue;
      const Eigen::Vector2f hit = plane.hit(ray, 1 / over_length);
      if (!plane.contains(hit)) continue;
      nearest = &plane;
      nearest_over_length = over_length;
      at = hit;
    }
    float grey = 0;
    if (nearest != nullptr) {
      const float length = 1 / nearest_over_length;
      const float scale = nearest->texels_per_m;
      const Eigen::Vector3f below = R_world_cam * rays_below[column].homogeneous();
      grey = nearest->texture->sample(at * scale, nearest->step(ray, next - ray, length) * scale,
                                      nearest->step(ray, below - ray, length) * scale);
    }
    const std::uint64_t random = RandomSource::mix(noise_seed + column);
    grey += noise_grey_[random % kNoiseSupply];
    pixels[column] = static_cast<std::uint8_t>(std::min(std::max(grey + 0.5F, 0.0F), 255.0F));
  }
}

}  // namespace ardrone_vslam
