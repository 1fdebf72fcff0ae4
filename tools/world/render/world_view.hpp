// SPDX-License-Identifier: BSD-3-Clause
// What the renderer makes of a scene before it meets the pixels.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "world/scene/world_scene.hpp"

namespace ardrone_vslam {

/// A surface as the camera sees it at one moment: floats relative to the camera's position.
struct SurfaceView {
  SurfaceView(const Surface& surface, const Eigen::Vector3d& camera_position)
      : right(surface.right.cast<float>()),
        down(surface.down.cast<float>()),
        width_m(static_cast<float>(surface.width_m)),
        height_m(static_cast<float>(surface.height_m)),
        texels_per_m(static_cast<float>(surface.texels_per_m)),
        texture(surface.texture.get()),
        grain(surface.grain.get()) {
    const Eigen::Vector3d to_corner = surface.corner - camera_position;
    const Eigen::Vector3d away = surface.right.cross(surface.down);
    const double distance_m = away.dot(to_corner);
    constexpr double kOnSurface_m = 1e-6;
    if (distance_m > kOnSurface_m) over_distance = (away / distance_m).cast<float>();
    offset_right_m = static_cast<float>(-surface.right.dot(to_corner));
    offset_down_m = static_cast<float>(-surface.down.dot(to_corner));
  }

  // With a ray: the reciprocal of the ray's length to the plane; 0 for one seen from behind.
  Eigen::Vector3f over_distance = Eigen::Vector3f::Zero();
  Eigen::Vector3f right;
  Eigen::Vector3f down;
  float offset_right_m = 0;  // of the camera's foot from the corner
  float offset_down_m = 0;
  float width_m;
  float height_m;
  float texels_per_m;
  const MipTexture* texture;
  const Grain* grain;

  /// Position on the surface of the ray's hit at this length.
  Eigen::Vector2f hit(const Eigen::Vector3f& ray, float length) const {
    return {offset_right_m + length * right.dot(ray), offset_down_m + length * down.dot(ray)};
  }
  /// Or so little outside that a ray along an edge meets one of its two sides.
  bool contains(const Eigen::Vector2f& at) const {
    constexpr float kEdgeTolerance_m = 1e-4F;
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
  /// Painted grey there, for a pixel whose neighbours see these steps further.
  float grey(const Eigen::Vector2f& at, const Eigen::Vector2f& step_x,
             const Eigen::Vector2f& step_y) const {
    float grey = texture->sample(at * texels_per_m, step_x * texels_per_m, step_y * texels_per_m);
    if (grain != nullptr) grey += grain->sample(at, step_x, step_y);
    return grey;
  }
};

/// A scene as the camera sees it at one moment.
struct SceneView {
  SceneView(const std::vector<const Surface*>& seen, const Lighting& lighting,
            const Eigen::Isometry3d& T_world_cam)
      : R_world_cam(T_world_cam.linear().cast<float>()),
        even(static_cast<float>(lighting.even)),
        lamp(static_cast<float>(lighting.lamp)),
        over_reach2(static_cast<float>(1 / (lighting.lamp_reach_m * lighting.lamp_reach_m))),
        to_lamp((lighting.lamp_m - T_world_cam.translation()).cast<float>()) {
    surfaces.reserve(seen.size());
    for (const Surface* surface : seen) surfaces.emplace_back(*surface, T_world_cam.translation());
  }

  /// Share of its grey that a place at `from_cam` shows.
  float light(const Eigen::Vector3f& from_cam) const {
    if (lamp == 0) return even;
    return even + lamp / (1 + (from_cam - to_lamp).squaredNorm() * over_reach2);
  }

  Eigen::Matrix3f R_world_cam;
  float even;
  float lamp;
  float over_reach2;
  Eigen::Vector3f to_lamp;
  std::vector<SurfaceView> surfaces;
};

}  // namespace ardrone_vslam
