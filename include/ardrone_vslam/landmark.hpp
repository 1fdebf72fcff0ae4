// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "ardrone_vslam/features.hpp"
#include "ardrone_vslam/shared_blocks.hpp"

namespace ardrone_vslam {

/// A half line in the map frame: camera position and unit direction.
struct Ray {
  Eigen::Vector3d origin_map = Eigen::Vector3d::Zero();      ///< where the camera was
  Eigen::Vector3d direction_map = Eigen::Vector3d::UnitX();  ///< unit length
};

/// A symmetric matrix of 3 x 3 in half the memory.
struct Symmetric3 {
  std::array<double, 6> upper{};  ///< its upper triangle, row by row

  Symmetric3() = default;  ///< zero
  /// Takes the upper triangle. Not explicit, as one stands for the other.
  template <class Matrix>
  Symmetric3(const Eigen::MatrixBase<Matrix>& full) {
    const Eigen::Matrix3d m = full;
    upper = {m(0, 0), m(0, 1), m(0, 2), m(1, 1), m(1, 2), m(2, 2)};
  }
  /// All of it.
  Eigen::Matrix3d full() const {
    const auto& [xx, xy, xz, yy, yz, zz] = upper;
    return (Eigen::Matrix3d() << xx, xy, xz, xy, yy, yz, xz, yz, zz).finished();
  }
  /// The sum of the diagonal.
  double trace() const { return upper[0] + upper[3] + upper[5]; }
};

/// A point of the world with known position. A map has many: what needs no more is in single
/// precision.
struct Landmark {
  std::uint32_t id = 0;                                    ///< no other landmark of the map has it
  std::uint32_t track_id = 0;                              ///< of the feature that saw it last
  Eigen::Vector3d position_map = Eigen::Vector3d::Zero();  ///< of the point; z is 0 in 2-D mode
  Symmetric3 covariance_m2;                                ///< MSCKF: beside its anchor's error
  std::uint32_t anchor_id = 0;  ///< MSCKF: the frame whose error it shares
  Eigen::Vector3f view_direction_map =
      Eigen::Vector3f::Zero();     ///< unit ray camera -> landmark when last described
  float seen_distance_m = 0;       ///< from the camera that saw it last; 0: not known
  float sigma_m = 0;               ///< sigma_l (5.19, 5.34)
  float depth_sigma_m = 0;         ///< along the ray of its last triangulation
  float parallax_rad = 0;          ///< between the first view and the one of its last triangulation
  float position_variance_m2 = 0;  ///< of the base position, per axis, when the landmark was made
                                   ///< (common drift, docs/thesis_estimator.md)
  float height_m =
      0;  ///< above the camera that saw it last; used in 2-D mode, where positions have no height
  DescriptorBits descriptor;       ///< as seen last
  int times_seen = 0;              ///< matches since it was made, that included
  int times_missed = 0;            ///< in view but not matched, since the last match
  int times_failed = 0;            ///< MSCKF: missed where others were found, or matched wrongly
  std::int64_t first_seen_ns = 0;  ///< stamp of the image that made it
  std::int64_t last_seen_ns = 0;   ///< stamp of the last image it was matched in
};

/// Those of a map.
using Landmarks = SharedBlocks<Landmark, 256>;

}  // namespace ardrone_vslam
