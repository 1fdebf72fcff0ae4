// SPDX-License-Identifier: BSD-3-Clause
#include "matching/frame_view.hpp"

#include <algorithm>

namespace ardrone_vslam {
void FrameView::reset(const ImageFeatures& features, const Eigen::Isometry3d& T_map_cam,
                      bool planar) {
  features_ = &features;
  planar_ = planar;
  origin_map_ = T_map_cam.translation();
  R_cam_map_ = T_map_cam.linear().transpose();
  rays_map_.clear();
  elevations_.clear();
  ideal_px_.clear();
  const Eigen::Matrix3d R_map_cam = T_map_cam.linear();
  for (const Eigen::Vector3f& bearing : features.bearing_cam) {
    Eigen::Vector3d ray = R_map_cam * bearing.cast<double>();
    if (planar) {
      elevations_.push_back(ray.z() / std::max(ray.head<2>().norm(), 1e-6));
      ray.z() = 0;
    }
    rays_map_.push_back(ray.normalized());
    ideal_px_.push_back(features.focal_length_px * bearing.head<2>() /
                        std::max(kFlattestCosine, bearing.z()));
    lower_px_ = lower_px_.cwiseMin(ideal_px_.back());
    upper_px_ = upper_px_.cwiseMax(ideal_px_.back());
  }
}

double FrameView::driftAngle_rad(std::uint32_t anchor_id, double variance_then_m2,
                                 double distance_m) const {
  const auto drift =
      std::lower_bound(drifts_.begin(), drifts_.end(), anchor_id,
                       [](const AnchorDrift& one, std::uint32_t id) { return one.anchor_id < id; });
  if (drift == drifts_.end() || drift->anchor_id != anchor_id)
    return sigmaSince_m(variance_then_m2) / distance_m;
  return std::sqrt(drift->position_m2 / (distance_m * distance_m) + drift->attitude_rad2);
}

bool FrameView::idealPixel(const Eigen::Vector3d& direction_map, double elevation,
                           Eigen::Vector2f& pixel_px) const {
  Eigen::Vector3d direction = direction_map;
  if (planar_) direction.z() = elevation * direction.head<2>().norm();
  const Eigen::Vector3d direction_cam = R_cam_map_ * direction;
  if (!(direction_cam.z() > kFlattestCosine * direction_cam.norm())) return false;
  const Eigen::Vector2d plane = direction_cam.head<2>() / direction_cam.z();
  pixel_px = features_->focal_length_px * plane.cast<float>();
  return (pixel_px.array() >= lower_px_.array()).all() &&
         (pixel_px.array() <= upper_px_.array()).all();
}

}  // namespace ardrone_vslam
