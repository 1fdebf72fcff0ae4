// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "ardrone_vslam/features.hpp"
#include "ardrone_vslam/landmark.hpp"

namespace ardrone_vslam {

/// How far the present pose may be off a frame that landmarks belong to: variances per axis.
struct AnchorDrift {
  std::uint32_t anchor_id = 0;  ///< of that frame: Clone::id
  double position_m2 = 0;       ///< of base
  double attitude_rad2 = 0;     ///< of its rotation vector
};

/// One frame's features as rays in the map, seen from a predicted camera pose. Needs no camera
/// model: windows are searched on the ideal image plane, f * (x / z, y / z) of the bearings ("ideal
/// pixels", the origin is the optical axis).
class FrameView {
 public:
  /// Of 87 degrees off the axis: no ideal pixel is computed beyond, as they go to infinity.
  static constexpr float kFlattestCosine = 0.05F;

  /// @param planar  2-D mode: the rays lose their z component and are normalised again (thesis 7.2)
  /// Bearings more than 87 degrees off the optical axis are found only by their tracks.
  /// @pre features outlives the view; its bearings are finite unit vectors
  void reset(const ImageFeatures& features, const Eigen::Isometry3d& T_map_cam, bool planar);

  /// What the camera has shown so far is forgotten: the next features are another one's.
  void changeCamera() {
    lower_px_.setZero();
    upper_px_.setZero();
  }

  /// How well the position is known: its variance per axis, and whether drift is shared
  /// (common drift, docs/thesis_estimator.md).
  void setPositionVariance(double variance_m2, bool common_drift) {
    position_variance_m2_ = variance_m2;
    common_drift_ = common_drift;
  }
  /// Of the predicted position, per axis; as set.
  double positionVariance_m2() const { return position_variance_m2_; }
  /// Sigma of the position relative to what was stored when its variance was
  /// `variance_then_m2`: the drift since then. Without common drift all positions are taken as
  /// independent and the whole sigma counts.
  double sigmaSince_m(double variance_then_m2) const {
    const double shared_m2 = common_drift_ ? variance_then_m2 : 0.0;
    return std::sqrt(std::max(position_variance_m2_ - shared_m2, 0.0));
  }

  /// Where the filter knows what landmarks share with the present pose. Ascending in anchor_id.
  void setDrifts(std::vector<AnchorDrift> drifts) { drifts_ = std::move(drifts); }
  /// By how much a landmark may be off its predicted direction because the pose is: one sigma.
  /// @param variance_then_m2  what counts for landmarks without an anchor, see sigmaSince_m
  double driftAngle_rad(std::uint32_t anchor_id, double variance_then_m2, double distance_m) const;

  /// What reset() was given.
  const ImageFeatures& features() const { return *features_; }
  /// Number of features.
  std::size_t size() const { return rays_map_.size(); }
  /// Of one feature, from the camera's position in map.
  Ray ray(std::size_t index) const { return {origin_map_, rays_map_[index]}; }
  /// The camera's position: predicted, or what setOrigin() said.
  const Eigen::Vector3d& origin_map() const { return origin_map_; }
  /// Moves all rays to another camera position (after the fusion); directions and windows stay.
  void setOrigin(const Eigen::Vector3d& origin_map) { origin_map_ = origin_map; }
  /// ImageFeatures::focal_length_px: one pixel is 1 / focalLength_px() rad.
  double focalLength_px() const { return features_->focal_length_px; }
  /// Whether this is the 2-D mode.
  bool planar() const { return planar_; }
  /// Takes directions in map to the camera's optical frame.
  const Eigen::Matrix3d& R_cam_map() const { return R_cam_map_; }
  /// Corners of the box of all ideal pixels that the camera has shown so far.
  const Eigen::Vector2f& lower_px() const { return lower_px_; }
  /// @copydoc lower_px
  const Eigen::Vector2f& upper_px() const { return upper_px_; }

  /// Ideal pixel of a direction in the map frame.
  /// @param elevation  tangent of the elevation, used in 2-D mode only, where directions are
  /// horizontal
  /// @return false when it is behind the camera or outside all that the camera has shown so far
  bool idealPixel(const Eigen::Vector3d& direction_map, double elevation,
                  Eigen::Vector2f& pixel_px) const;
  /// Tangent of a feature's elevation above the horizontal plane of the map; 0 outside the 2-D
  /// mode.
  double elevation(std::size_t index) const { return planar_ ? elevations_[index] : 0.0; }

  /// Of each feature; beyond 87 degrees off the axis as if it were there.
  const std::vector<Eigen::Vector2f>& idealPixels() const { return ideal_px_; }

 private:
  const ImageFeatures* features_ = nullptr;
  bool planar_ = false;
  bool common_drift_ = false;
  double position_variance_m2_ = 0;
  std::vector<AnchorDrift> drifts_;
  Eigen::Vector3d origin_map_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d R_cam_map_ = Eigen::Matrix3d::Identity();
  std::vector<Eigen::Vector3d> rays_map_;
  std::vector<double> elevations_;  // 2-D mode only
  std::vector<Eigen::Vector2f> ideal_px_;
  Eigen::Vector2f lower_px_ = Eigen::Vector2f::Zero();  // box of all ideal pixels since the start
  Eigen::Vector2f upper_px_ = Eigen::Vector2f::Zero();
};

}  // namespace ardrone_vslam
