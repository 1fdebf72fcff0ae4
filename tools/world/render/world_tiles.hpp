// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "world/scene/world_scene.hpp"

namespace ardrone_vslam {

/// How far a camera may be from the pose that it is taken to have.
struct PoseSlack {
  double angle_rad = 0;
  double shift_m = 0;
};

/// The surfaces that may show in one band of rows, and for each of its tiles, by their places in
/// `surfaces`, those that may show there. Both keep the scene's order.
struct BandSurfaces {
  std::vector<const Surface*> surfaces;
  std::vector<std::vector<std::uint16_t>> of_tile;
};

/// An image cut into tiles, each with the pyramid around its rays, so that a pixel meets only a few
/// of a scene's surfaces. Leaves out nothing that could be seen.
class TilePyramids {
 public:
  static constexpr int kTile_px = 16;

  /// @param rays  (x, y, 1) of each pixel, row by row, `stride` to a row
  TilePyramids(const std::vector<Eigen::Vector2f>& rays, int width_px, int height_px, int stride);

  int bands() const { return bands_; }
  /// What a camera within `slack` of the pose may see in the band's rows.
  BandSurfaces seenIn(int band, const Scene& scene, const Eigen::Isometry3d& T_world_cam,
                      const PoseSlack& slack) const;

 private:
  /// Inward unit normals of the pyramid's four sides: left, right, top, bottom.
  using Sides = Eigen::Matrix<double, 4, 3>;

  static Sides sidesAround(const Eigen::Vector2d& low, const Eigen::Vector2d& high);

  int bands_;
  int tiles_in_band_;
  std::vector<Sides> tiles_;
  std::vector<Sides> whole_bands_;
};

}  // namespace ardrone_vslam
