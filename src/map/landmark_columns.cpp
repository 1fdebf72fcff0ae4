// SPDX-License-Identifier: BSD-3-Clause
#include "map/landmark_columns.hpp"

#include <cmath>

#include "kernels/kernels.hpp"
#include "linear/portable_math.hpp"
#include "map/landmark_map.hpp"
#include "matching/growth.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kFarthestOrigin_m = 256;
constexpr float kNearest_m = 1e-3F;

/// c |c| for the smallest cosine; half a turn culls nothing, however the cosine is rounded.
float signedSquareOfCosine(double angle_deg) {
  const double cosine = portable::cos(angle_deg * M_PI / 180);
  return angle_deg >= 180 ? -2.F : static_cast<float>(cosine * std::abs(cosine));
}

kernels::ProjectCamera cameraOf(const FrameView& view, const ProjectionLimits& limits,
                                const Eigen::Vector3d& origin_map) {
  kernels::ProjectCamera camera{};
  const Eigen::Vector3f position = (view.origin_map() - origin_map).cast<float>();
  for (int axis = 0; axis < 3; ++axis) camera.position_m[axis] = position[axis];
  for (int row = 0; row < 3; ++row) {
    const double scale = row < 2 ? view.focalLength_px() : 1;
    for (int column = 0; column < 3; ++column) {
      camera.rows[3 * row + column] = static_cast<float>(scale * view.R_cam_map()(row, column));
    }
  }
  camera.left_px = view.lower_px().x();
  camera.right_px = view.upper_px().x();
  camera.top_px = view.lower_px().y();
  camera.bottom_px = view.upper_px().y();
  camera.flattest2 = FrameView::kFlattestCosine * FrameView::kFlattestCosine;
  camera.cosine2 = signedSquareOfCosine(limits.max_view_angle_deg);
  camera.nearest_m2 = kNearest_m * kNearest_m;
  camera.ratio2 = static_cast<float>(limits.max_distance_ratio * limits.max_distance_ratio);
  return camera;
}

}  // namespace

template <class Action>
void LandmarkColumns::forEachColumn(const Action& action) {
  for (auto* column : {&x_m_, &y_m_, &z_m_, &height_m_, &view_x_, &view_y_, &view_z_, &seen_m2_,
                       &position_variance_m2_}) {
    action(*column);
  }
  action(track_id_);
  action(anchor_id_);
}

void LandmarkColumns::reserve(std::size_t count) {
  forEachColumn([count](auto& column) { column.reserve(count); });
}

void LandmarkColumns::resize(std::size_t count) {
  forEachColumn([count](auto& column) {
    growByAnEighth(column, count);
    column.resize(count);
  });
}

void LandmarkColumns::set(std::size_t index, const Landmark& landmark) {
  const Eigen::Vector3f offset = (landmark.position_map - origin_map_).cast<float>();
  x_m_[index] = offset.x();
  y_m_[index] = offset.y();
  z_m_[index] = offset.z();
  height_m_[index] = landmark.height_m;
  view_x_[index] = landmark.view_direction_map.x();
  view_y_[index] = landmark.view_direction_map.y();
  view_z_[index] = landmark.view_direction_map.z();
  seen_m2_[index] = landmark.seen_distance_m * landmark.seen_distance_m;
  position_variance_m2_[index] = landmark.position_variance_m2;
  track_id_[index] = landmark.track_id;
  anchor_id_[index] = landmark.anchor_id;
}

float LandmarkColumns::seenDistance_m(std::size_t index) const {
  return std::sqrt(seen_m2_[index]);
}

bool LandmarkColumns::follow(const Eigen::Vector3d& camera_map) {
  if ((camera_map - origin_map_).norm() <= kFarthestOrigin_m) return false;
  origin_map_ = camera_map;
  return true;
}

void LandmarkColumns::project(const FrameView& view, const ProjectionLimits& limits,
                              VisibleLandmarks& visible) const {
  const std::size_t room = size() + kernels::kProjectSlack;
  if (visible.index.size() < room) {
    visible.index.resize(room);
    visible.x_px.resize(room);
    visible.y_px.resize(room);
    visible.distance_m.resize(room);
  }
  // In 2-D mode positions and camera have z = 0, and the height above the camera decides the row.
  const float* image_z_m = view.planar() ? height_m_.data() : z_m_.data();
  const kernels::ProjectColumns columns{x_m_.data(),    y_m_.data(),    z_m_.data(),
                                        image_z_m,      view_x_.data(), view_y_.data(),
                                        view_z_.data(), seen_m2_.data()};
  const kernels::ProjectOutput out{visible.index.data(), visible.x_px.data(), visible.y_px.data(),
                                   visible.distance_m.data()};
  visible.count = static_cast<std::size_t>(kernels::kernelsInUse().project(
      columns, static_cast<int>(size()), cameraOf(view, limits, origin_map_), out));
}

}  // namespace ardrone_vslam
