// SPDX-License-Identifier: BSD-3-Clause
#include "world_views.hpp"

#include "sequences/sequence.hpp"
#include "world/scene/world_room.hpp"

namespace ardrone_vslam::quality {
namespace {

constexpr std::uint64_t kWorldSeed = 0;
constexpr double kSamePlace_m = 0.01;

}  // namespace

Eigen::Isometry3d lookAlong(double yaw_rad, const Eigen::Vector3d& position_m) {
  return Eigen::Translation3d(position_m) * Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) *
         forwardCamera();
}

std::optional<Eigen::Vector3d> pointSeen(const Scene& scene, const CameraModel& camera,
                                         const Eigen::Isometry3d& T_world_cam,
                                         const Eigen::Vector2d& pixel_px) {
  const auto bearing_cam = camera.bearing(pixel_px);
  if (!bearing_cam) return std::nullopt;
  const Eigen::Vector3d ray = T_world_cam.linear() * *bearing_cam;
  const auto length = rangeAlong(scene, T_world_cam.translation(), ray);
  if (!length) return std::nullopt;
  return T_world_cam.translation() + ray * *length;
}

std::optional<Eigen::Vector2d> transferPixel(const Scene& scene, const CameraModel& camera,
                                             const Eigen::Isometry3d& T_world_from,
                                             const Eigen::Isometry3d& T_world_to,
                                             const Eigen::Vector2d& pixel_px) {
  const auto point_world = pointSeen(scene, camera, T_world_from, pixel_px);
  if (!point_world) return std::nullopt;
  const auto other_px = camera.project(T_world_to.inverse() * *point_world);
  if (!other_px) return std::nullopt;
  const auto seen_back = pointSeen(scene, camera, T_world_to, *other_px);
  if (!seen_back || (*seen_back - *point_world).norm() > kSamePlace_m) return std::nullopt;
  return other_px;
}

WorldViews::WorldViews(const CameraIntrinsics& camera)
    : scene_(makeRoom(kWorldSeed)), camera_(camera), renderer_(camera) {}

cv::Mat WorldViews::render(const Eigen::Isometry3d& T_world_cam, std::uint64_t noise_seed) const {
  return renderer_.render(scene_, T_world_cam, noise_seed);
}

PairGeometry WorldViews::geometry(const Eigen::Isometry3d& T_world_a,
                                  const Eigen::Isometry3d& T_world_b) const {
  const auto mapFrom = [this](const Eigen::Isometry3d& from, const Eigen::Isometry3d& to) {
    return [this, from, to](const Eigen::Vector2d& pixel_px) {
      return transferPixel(scene_, camera_, from, to, pixel_px);
    };
  };
  const auto& intrinsics = camera_.intrinsics();
  const Eigen::Vector2d size_px(intrinsics.width_px, intrinsics.height_px);
  return {mapFrom(T_world_a, T_world_b), mapFrom(T_world_b, T_world_a), size_px, size_px};
}

}  // namespace ardrone_vslam::quality
