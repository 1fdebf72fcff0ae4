// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "matching/frame_view.hpp"

namespace ardrone_vslam {

struct Landmark;

/// What is culled before landmarks are searched (thesis 8.1-6).
struct ProjectionLimits {
  double max_view_angle_deg = 60;   ///< between the present and the last view's direction
  double max_distance_ratio = 1e6;  ///< present over last distance, or last over present
};

/// The landmarks that a predicted camera sees, by ascending index: the first `count` entries of
/// each array; what lies behind them means nothing.
struct VisibleLandmarks {
  std::size_t count = 0;            ///< of visible landmarks
  std::vector<std::int32_t> index;  ///< into LandmarkMap::all()
  std::vector<float> x_px;          ///< ideal pixel, see FrameView
  std::vector<float> y_px;          ///< likewise
  std::vector<float> distance_m;    ///< from the camera

  /// Ideal pixel of visible landmark i, i < count.
  Eigen::Vector2f pixel_px(std::size_t i) const { return {x_px[i], y_px[i]}; }
};

/// What a search needs of all landmarks, each quantity an array of its own, so that 100,000 are
/// projected in a tenth of a millisecond. Positions are single precision, relative to an origin
/// that follows the camera: within 256 m + d of it they are rounded by less than 16 um + 6e-8 d.
class LandmarkColumns {
 public:
  /// Takes the memory for so many landmarks.
  void reserve(std::size_t count);
  /// Makes room for, or forgets, landmarks at the end.
  void resize(std::size_t count);
  /// Copies a landmark to its place.
  void set(std::size_t index, const Landmark& landmark);

  /// Moves the origin to the camera if it is further than 256 m from it.
  /// @return true if it has moved: every landmark must be set again
  bool follow(const Eigen::Vector3d& camera_map);

  /// Landmarks that the view's predicted pose puts within the box of all that the camera has shown
  /// so far, less the culled ones. O(landmarks).
  void project(const FrameView& view, const ProjectionLimits& limits,
               VisibleLandmarks& visible) const;

  /// Number of landmarks.
  std::size_t size() const { return track_id_.size(); }
  /// Landmark::track_id.
  std::uint32_t trackId(std::size_t index) const { return track_id_[index]; }
  /// Landmark::position_variance_m2.
  float positionVariance_m2(std::size_t index) const { return position_variance_m2_[index]; }
  /// Landmark::anchor_id.
  std::uint32_t anchorId(std::size_t index) const { return anchor_id_[index]; }
  /// From where it was last seen; 0: not known.
  float seenDistance_m(std::size_t index) const;

 private:
  template <class Action>
  void forEachColumn(const Action& action);

  Eigen::Vector3d origin_map_ = Eigen::Vector3d::Zero();
  std::vector<float> x_m_;
  std::vector<float> y_m_;
  std::vector<float> z_m_;
  std::vector<float> height_m_;  // 2-D mode
  std::vector<float> view_x_;
  std::vector<float> view_y_;
  std::vector<float> view_z_;
  std::vector<float> seen_m2_;
  std::vector<float> position_variance_m2_;
  std::vector<std::uint32_t> track_id_;
  std::vector<std::uint32_t> anchor_id_;
};

}  // namespace ardrone_vslam
