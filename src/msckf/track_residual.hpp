// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "window/window_state.hpp"

namespace ardrone_vslam {

/// One view of a point by a frame of the window.
struct TrackView {
  std::size_t frame = 0;                                    ///< index into WindowState::frames()
  Eigen::Vector3d bearing_base = Eigen::Vector3d::UnitX();  ///< measured unit ray, axes of base
};

/// The views of one track, ascending in the frame, that somebody else holds.
class TrackViews {
 public:
  TrackViews() = default;
  /// @param first  of `count` views in a row, which must outlive this
  TrackViews(const TrackView* first, std::size_t count) : first_(first), count_(count) {}
  /// All of a vector, which must outlive this.
  // NOLINTNEXTLINE(google-explicit-constructor): a vector is one
  TrackViews(const std::vector<TrackView>& views) : TrackViews(views.data(), views.size()) {}

  /// Number of views.
  std::size_t size() const { return count_; }
  /// The oldest view.
  const TrackView* begin() const { return first_; }
  /// Behind the newest view.
  const TrackView* end() const { return first_ + count_; }
  /// The oldest view. @pre there is one
  const TrackView& front() const { return *first_; }
  /// The newest view. @pre there is one
  const TrackView& back() const { return *(end() - 1); }

 private:
  const TrackView* first_ = nullptr;
  std::size_t count_ = 0;
};

/// A point by all its views.
struct TrackPoint {
  Eigen::Vector3d position_map = Eigen::Vector3d::Zero();   ///< of the point
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Zero();  ///< by the noise of the rays alone
  double parallax_rad = 0;                                  ///< largest angle to the first ray
};

/// Where a measured ray lies beside the predicted one, and how that changes with the errors of pose
/// and point: residual = pose * (true pose - pose) + point * (true point - point), in the tangent
/// plane of the PREDICTED ray (Jacobians at measured rays bias the motion).
struct RayResidual {
  Eigen::Vector2d residual = Eigen::Vector2d::Zero();                      ///< [rad]
  Eigen::Matrix<double, 2, 6> pose = Eigen::Matrix<double, 2, 6>::Zero();  ///< position, attitude
  Eigen::Matrix<double, 2, 3> point =
      Eigen::Matrix<double, 2, 3>::Zero();  ///< derivative by the point [rad/m]
};

/// @param camera_base  the camera's position in base
/// @return nothing when the point is at the camera or more than 60 degrees off the ray
std::optional<RayResidual> rayResidual(const Clone& pose, const Eigen::Vector3d& camera_base,
                                       const Eigen::Vector3d& bearing_base,
                                       const Eigen::Vector3d& point_map);

/// Least-squares point of rays from given poses.
/// @return nothing for fewer than two views, parallel rays, or a point behind a camera
std::optional<TrackPoint> triangulateTrack(const std::vector<Clone>& frames,
                                           const Eigen::Vector3d& camera_base, TrackViews views,
                                           double angle_sigma_rad);

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
std::optional<TrackResidual> residualOf(const WindowState& state,
                                        const Eigen::Vector3d& camera_base, TrackViews views,
                                        const TrackPoint& point, double angle_sigma_rad,
                                        const std::optional<FloorHeight>& floor = std::nullopt);

/// What the frames' errors do to a triangulated point beside what it shares with its anchor, and so
/// follows when that is corrected. Errors of attitude count: over a short baseline they are the
/// greater part of the depth's. O(views^2).
/// @param anchor  index into WindowState::frames()
Eigen::Matrix3d covarianceByFrames(const WindowState& state, const Eigen::Vector3d& camera_base,
                                   TrackViews views, const Eigen::Vector3d& point_map,
                                   std::size_t anchor);

/// The value below which a chi-square variable lies in 95 % of the cases, within 1 % (Wilson and
/// Hilferty 1931).
double chiSquare95(int degrees_of_freedom);

}  // namespace ardrone_vslam
