// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <string>

namespace ardrone_vslam {

/// Pinhole camera with Brown's distortion (plumb_bob): k1, k2, k3 radial, p1, p2 tangential.
struct CameraIntrinsics {
  int width_px = 0;   ///< of the images that it was calibrated for
  int height_px = 0;  ///< likewise
  double fx_px = 0;   ///< focal length, columns
  double fy_px = 0;   ///< focal length, rows
  double cx_px = 0;   ///< column of the optical axis; pixel centres are integers
  double cy_px = 0;   ///< its row
  double k1 = 0;      ///< radial, of r^2, r on the image plane z = 1
  double k2 = 0;      ///< radial, of r^4
  double p1 = 0;      ///< tangential
  double p2 = 0;      ///< tangential
  double k3 = 0;      ///< radial, of r^6

  /// Whether all numbers are the same: the same camera at the same size.
  bool operator==(const CameraIntrinsics& other) const;
};

constexpr double kShortestFocal = 0.05;  ///< [image widths], a field of view of 169 degrees
constexpr double kLongestFocal = 50;     ///< [image widths], a field of view of 1.1 degrees

/// What cannot be a camera, and what helps: size, values not finite, focal length, principal point
/// outside the image, distortion that folds back or moves pixels by more than a fifth already
/// within a tenth of the half diagonal. Empty when it can be one.
std::string calibrationFault(const CameraIntrinsics& intrinsics);

class LensTable;

/// Inverse of the distortion. `kTable`: the exact one, looked up, within 1e-6 px of it; takes a
/// millisecond at construction. `kExact`: Newton's method to 1e-12 of the image plane.
/// `kClosedForm`: Drap & Lefevre's three-term series (5.6-5.11), radial only, pixels off for strong
/// lenses.
enum class UndistortMethod { kTable, kExact, kClosedForm };

/// Pixel <-> bearing in the optical frame (x right, y down, z forward). Immutable; safe to share
/// between threads.
class CameraModel {
 public:
  /// @throws std::invalid_argument with the calibrationFault
  explicit CameraModel(const CameraIntrinsics& intrinsics,
                       UndistortMethod method = UndistortMethod::kExact);

  /// Unit bearing of a (distorted) pixel.
  /// @return nothing for pixels beyond the radius where the model folds back, or which it maps to
  /// more than 84 degrees off the axis; the same ones with every method if p1 = p2 = 0.
  std::optional<Eigen::Vector3d> bearing(const Eigen::Vector2d& pixel_px) const;

  /// Pixel of a point or direction in the optical frame; it may lie outside the image.
  /// @return nothing behind the camera, beyond the fold, or with distortion more than 84 degrees
  /// off the axis.
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& point_cam) const;

  /// Whether a pixel is in the image and at least `border_px` from its edge.
  bool isInImage(const Eigen::Vector2d& pixel_px, double border_px = 0) const;

  /// Geometric mean of fx and fy: one pixel is 1 / focalLength_px() rad at the centre.
  double focalLength_px() const { return focal_length_px_; }
  /// Undistorted radius on the image plane (z = 1) beyond which the radial model is no longer
  /// monotonic; infinity if it never folds.
  double foldRadius() const { return fold_radius_; }
  /// What it was made with.
  const CameraIntrinsics& intrinsics() const { return intrinsics_; }

 private:
  Eigen::Vector2d distort(const Eigen::Vector2d& plane) const;
  Eigen::Vector2d undistortRadial(const Eigen::Vector2d& distorted) const;
  std::optional<Eigen::Vector2d> undistortTangential(const Eigen::Vector2d& distorted,
                                                     Eigen::Vector2d plane) const;
  Eigen::Vector2d undistortClosedForm(const Eigen::Vector2d& distorted) const;

  CameraIntrinsics intrinsics_;
  UndistortMethod method_;
  bool tangential_ = false;
  double focal_length_px_;
  double fold_radius_;
  double widest_radius_ = std::numeric_limits<double>::infinity();
  double widest_distorted2_ = std::numeric_limits<double>::infinity();
  std::array<double, 3> closed_form_{};
  std::shared_ptr<const LensTable> table_;
};

}  // namespace ardrone_vslam
