// SPDX-License-Identifier: BSD-3-Clause
#include "world/render/world_tiles.hpp"

#include <algorithm>

namespace ardrone_vslam {
namespace {

/// Rendering is done in floats and counts a hit this far outside a surface as one.
constexpr double kMargin_m = 1e-3;

using Corners = Eigen::Matrix<double, 3, 4>;

Corners cornersOf(const Surface& surface) {
  const Eigen::Vector3d right = surface.right * surface.width_m;
  const Eigen::Vector3d down = surface.down * surface.height_m;
  Corners corners;
  corners << surface.corner, surface.corner + right, surface.corner + down,
      surface.corner + right + down;
  return corners;
}

}  // namespace

TilePyramids::TilePyramids(const std::vector<Eigen::Vector2f>& rays, int width_px, int height_px,
                           int stride)
    : bands_((height_px + kTile_px - 1) / kTile_px),
      tiles_in_band_((width_px + kTile_px - 1) / kTile_px) {
  for (int band = 0; band < bands_; ++band) {
    Eigen::Vector2d band_low(1e9, 1e9), band_high(-1e9, -1e9);
    for (int tile = 0; tile < tiles_in_band_; ++tile) {
      Eigen::Vector2d low(1e9, 1e9), high(-1e9, -1e9);
      for (int row = band * kTile_px; row < std::min(height_px, (band + 1) * kTile_px); ++row) {
        const Eigen::Vector2f* of_row = rays.data() + static_cast<std::ptrdiff_t>(row) * stride;
        for (int x = tile * kTile_px; x < std::min(width_px, (tile + 1) * kTile_px); ++x) {
          const Eigen::Vector2d ray = of_row[x].cast<double>();
          low = low.cwiseMin(ray);
          high = high.cwiseMax(ray);
        }
      }
      tiles_.push_back(sidesAround(low, high));
      band_low = band_low.cwiseMin(low);
      band_high = band_high.cwiseMax(high);
    }
    whole_bands_.push_back(sidesAround(band_low, band_high));
  }
}

TilePyramids::Sides TilePyramids::sidesAround(const Eigen::Vector2d& low,
                                              const Eigen::Vector2d& high) {
  Sides sides;
  sides << 1, 0, -low.x(), -1, 0, high.x(), 0, 1, -low.y(), 0, -1, high.y();
  sides.rowwise().normalize();
  return sides;
}

BandSurfaces TilePyramids::seenIn(int band, const Scene& scene,
                                  const Eigen::Isometry3d& T_world_cam,
                                  const PoseSlack& slack) const {
  const Eigen::Isometry3d T_cam_world = T_world_cam.inverse();
  BandSurfaces seen;
  seen.of_tile.resize(static_cast<std::size_t>(tiles_in_band_));
  for (const auto& surface : scene.surfaces) {
    const Eigen::Vector3d away = surface.right.cross(surface.down);
    if (away.dot(surface.corner - T_world_cam.translation()) < -slack.shift_m) continue;
    const Corners corners = (T_cam_world * cornersOf(surface).colwise().homogeneous()).eval();
    // A corner moves by no more than this when the camera does: what is farther outside of one side
    // with all corners is hidden from the whole pyramid.
    const Eigen::RowVector4d moves =
        (slack.angle_rad * corners.colwise().norm()).array() + slack.shift_m + kMargin_m;
    const auto isOutside = [&](const Sides& sides) {
      return ((sides * corners).rowwise() + moves).rowwise().maxCoeff().minCoeff() < 0;
    };
    if (isOutside(whole_bands_[static_cast<std::size_t>(band)])) continue;
    bool is_seen = false;
    const auto* tiles = tiles_.data() + static_cast<std::ptrdiff_t>(band) * tiles_in_band_;
    for (int tile = 0; tile < tiles_in_band_; ++tile) {
      if (isOutside(tiles[tile])) continue;
      seen.of_tile[static_cast<std::size_t>(tile)].push_back(
          static_cast<std::uint16_t>(seen.surfaces.size()));
      is_seen = true;
    }
    if (is_seen) seen.surfaces.push_back(&surface);
  }
  return seen;
}

}  // namespace ardrone_vslam
