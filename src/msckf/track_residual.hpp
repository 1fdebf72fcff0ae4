// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "window/rays.hpp"
#include "window/window_state.hpp"

namespace ardrone_vslam {

/// The point lies so far below the base that saw it last: on the floor.
struct FloorHeight {
  double height_m = 0;  ///< of base above the point
  double sigma_m = 0;   ///< its standard deviation
};

/// The two rows of a TrackResidual that a view gives; the second one of a FloorHeight is empty.
struct ViewRows {
  int coordinate = 0;                 ///< of WindowState: the first of the frame's six
  Eigen::Matrix<double, 2, 6> pose;   ///< block of A
  Eigen::Matrix<double, 2, 3> point;  ///< rows of U
  Eigen::Matrix<double, 6, 3> along;  ///< pose' point
  Eigen::Vector2d residual;           ///< of r, projected
};

/// What a track says of its frames when nothing is known of its point: rows r = A e + n of unit
/// noise, two a view, of which a projection I - U U', U's columns orthonormal, takes out the three
/// directions of the point. A has one 2 x 6 block a view, and so nothing but distance() costs more
/// than O(views^2).
struct TrackResidual {
  std::vector<ViewRows> views;  ///< ascending in the coordinate
  bool has_height = false;      ///< the last of them is a FloorHeight

  /// Rows that the projection leaves.
  int degreesOfFreedom() const {
    return 2 * static_cast<int>(views.size()) - (has_height ? 1 : 0) - 3;
  }
  /// |r - A e|^2, projected. @param first  coordinate that `error` begins with
  double squaredRest(const Eigen::VectorXd& error, int first) const;
  /// r' (H P H' + I)^-1 r, H the projected A, on what the projection leaves.
  double distance(const WindowState& state) const;
  /// Adds the lower half of weight H' H, and weight H' r; the information's coordinates must be
  /// consecutive.
  void addTo(Information& information, double weight) const;
};

/// @param floor  what is known of the point beside the views
/// @return nothing when a ray is too far off its prediction
std::optional<TrackResidual> residualOf(const WindowState& state, const Eigen::Vector3d& camera_rig,
                                        TrackViews views, const TrackPoint& point,
                                        const std::optional<FloorHeight>& floor = std::nullopt);

/// What the frames' errors do to a triangulated point beside what it shares with its anchor, and so
/// follows when that is corrected. Errors of attitude count: over a short baseline they are the
/// greater part of the depth's. O(views^2).
/// @param anchor  index into WindowState::frames()
Eigen::Matrix3d covarianceByFrames(const WindowState& state, const Eigen::Vector3d& camera_rig,
                                   TrackViews views, const Eigen::Vector3d& point_map,
                                   std::size_t anchor);

/// The value below which a chi-square variable lies in 95 % of the cases, within 1 % (Wilson and
/// Hilferty 1931).
double chiSquare95(int degrees_of_freedom);

}  // namespace ardrone_vslam
