// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/camera_model.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

#include "camera/brown_model.hpp"
#include "camera/lens_table.hpp"
#include "linear/portable_math.hpp"

namespace ardrone_vslam {
namespace {

/// Sizes and focal lengths. @return the fault
std::string pinholeFault(const CameraIntrinsics& c) {
  if (c.width_px <= 0 || c.height_px <= 0) return "the image size is not positive";
  for (const double value : {c.fx_px, c.fy_px, c.cx_px, c.cy_px, c.k1, c.k2, c.p1, c.p2, c.k3}) {
    if (!std::isfinite(value)) return "a value of K or D is not finite";
  }
  if (c.fx_px <= 0 || c.fy_px <= 0)
    return "the focal length (K[0], K[4]) is not positive, the camera is uncalibrated";
  std::ostringstream fault;
  for (const double focal_px : {c.fx_px, c.fy_px}) {
    const double widths = focal_px / c.width_px;
    if (widths >= kShortestFocal && widths <= kLongestFocal) continue;
    fault << "the focal length " << focal_px << " px (K[0], K[4]) is not within " << kShortestFocal
          << " and " << kLongestFocal << " times the image width of " << c.width_px << " px";
    return fault.str();
  }
  if (c.cx_px < 0 || c.cx_px >= c.width_px || c.cy_px < 0 || c.cy_px >= c.height_px) {
    fault << "the principal point (" << c.cx_px << ", " << c.cy_px
          << ") (K[2], K[5]) lies outside the image of " << c.width_px << "x" << c.height_px;
  }
  return fault.str();
}

/// No lens distorts the middle of its image much; one that seems to has wrong coefficients.
/// @return the fault
std::string lensFault(const CameraIntrinsics& c) {
  constexpr double kMiddle = 0.1;        // of the half diagonal
  constexpr double kLargestShare = 0.2;  // of the radius, by which a pixel may move there
  constexpr int kSteps = 64;
  const double radius =
      kMiddle * 0.5 * portable::hypot(c.width_px, c.height_px) / std::sqrt(c.fx_px * c.fy_px);
  bool folds = false;
  double moved = 3 * (std::abs(c.p1) + std::abs(c.p2)) * radius;
  for (int i = 1; i <= kSteps; ++i) {
    const double r = radius * i / kSteps;
    folds = folds || !(radialSlope(c, r * r) > 0);
    moved = std::max(moved, std::abs(radialFactor(c, r * r) - 1));
  }
  if (!folds && moved <= kLargestShare) return {};
  std::ostringstream fault;
  fault << "the distortion (k1 " << c.k1 << ", k2 " << c.k2 << ", p1 " << c.p1 << ", p2 " << c.p2
        << ", k3 " << c.k3 << ") " << (folds ? "folds back" : "moves pixels by more than a fifth")
        << " already within a tenth of the image's half diagonal";
  return fault.str();
}

/// Unit direction of a point of the image plane.
std::optional<Eigen::Vector3d> directionOf(const std::optional<Eigen::Vector2d>& plane) {
  if (!plane) return std::nullopt;
  return Eigen::Vector3d(plane->x(), plane->y(), 1).normalized();
}

}  // namespace

std::string calibrationFault(const CameraIntrinsics& intrinsics) {
  std::string fault = pinholeFault(intrinsics);
  if (fault.empty()) fault = lensFault(intrinsics);
  if (!fault.empty()) fault += "; calibrate the camera or correct its camera_info";
  return fault;
}

bool CameraIntrinsics::operator==(const CameraIntrinsics& o) const {
  return width_px == o.width_px && height_px == o.height_px && fx_px == o.fx_px &&
         fy_px == o.fy_px && cx_px == o.cx_px && cy_px == o.cy_px && k1 == o.k1 && k2 == o.k2 &&
         p1 == o.p1 && p2 == o.p2 && k3 == o.k3;
}

CameraModel::CameraModel(const CameraIntrinsics& intrinsics, UndistortMethod method)
    : intrinsics_(intrinsics), method_(method) {
  const std::string fault = calibrationFault(intrinsics);
  if (!fault.empty()) throw std::invalid_argument("camera calibration: " + fault);
  focal_length_px_ = std::sqrt(intrinsics.fx_px * intrinsics.fy_px);
  fold_radius_ = findFoldRadius(intrinsics);
  const double k1 = intrinsics.k1;
  const double k2 = intrinsics.k2;
  const double k3 = intrinsics.k3;
  tangential_ = intrinsics.p1 != 0 || intrinsics.p2 != 0;
  const bool radial = k1 != 0 || k2 != 0 || k3 != 0;
  if (!radial && !tangential_) return;

  widest_radius_ = std::min(fold_radius_, kWidestRadius);
  const double widest_distorted =
      widest_radius_ * radialFactor(intrinsics, widest_radius_ * widest_radius_);
  widest_distorted2_ = widest_distorted * widest_distorted;
  closed_form_ = {-k1, 3 * k1 * k1 - k2, -12 * k1 * k1 * k1 + 8 * k1 * k2 - k3};  // (5.6-5.8)
  if (method == UndistortMethod::kTable && radial) {
    table_ = std::make_shared<const LensTable>(intrinsics, widest_radius_);
  }
}

std::optional<Eigen::Vector3d> CameraModel::bearing(const Eigen::Vector2d& pixel_px) const {
  const Eigen::Vector2d distorted((pixel_px.x() - intrinsics_.cx_px) / intrinsics_.fx_px,
                                  (pixel_px.y() - intrinsics_.cy_px) / intrinsics_.fy_px);
  const double distorted2 = distorted.squaredNorm();
  if (!(distorted2 < widest_distorted2_)) return std::nullopt;
  if (table_ && table_->covers(distorted2)) {
    const Eigen::Array2d found = table_->at(distorted2);
    const double scale = found.x();
    const double z = found.y();
    if (!tangential_) return Eigen::Vector3d(distorted.x() * scale, distorted.y() * scale, z);
    return directionOf(undistortTangential(distorted, distorted * (scale / z)));
  }
  if (method_ == UndistortMethod::kClosedForm) return directionOf(undistortClosedForm(distorted));
  const Eigen::Vector2d plane = undistortRadial(distorted);
  return directionOf(tangential_ ? undistortTangential(distorted, plane) : plane);
}

std::optional<Eigen::Vector2d> CameraModel::project(const Eigen::Vector3d& point_cam) const {
  if (!(point_cam.z() > 0)) return std::nullopt;
  const Eigen::Vector2d plane = point_cam.head<2>() / point_cam.z();
  if (!(plane.norm() < widest_radius_)) return std::nullopt;
  const Eigen::Vector2d distorted = distort(plane);
  return Eigen::Vector2d(intrinsics_.fx_px * distorted.x() + intrinsics_.cx_px,
                         intrinsics_.fy_px * distorted.y() + intrinsics_.cy_px);
}

bool CameraModel::isInImage(const Eigen::Vector2d& pixel_px, double border_px) const {
  return pixel_px.x() >= border_px && pixel_px.y() >= border_px &&
         pixel_px.x() <= intrinsics_.width_px - 1 - border_px &&
         pixel_px.y() <= intrinsics_.height_px - 1 - border_px;
}

Eigen::Vector2d CameraModel::distort(const Eigen::Vector2d& plane) const {
  const double x = plane.x();
  const double y = plane.y();
  const double r2 = plane.squaredNorm();
  const double radial = radialFactor(intrinsics_, r2);
  return {x * radial + 2 * intrinsics_.p1 * x * y + intrinsics_.p2 * (r2 + 2 * x * x),
          y * radial + intrinsics_.p1 * (r2 + 2 * y * y) + 2 * intrinsics_.p2 * x * y};
}

Eigen::Vector2d CameraModel::undistortRadial(const Eigen::Vector2d& distorted) const {
  const double r_distorted = distorted.norm();
  if (std::isinf(widest_radius_) || r_distorted == 0) return distorted;
  return distorted * (undistortedRadius(intrinsics_, r_distorted, widest_radius_) / r_distorted);
}

std::optional<Eigen::Vector2d> CameraModel::undistortTangential(const Eigen::Vector2d& distorted,
                                                                Eigen::Vector2d plane) const {
  constexpr double kTolerance = 1e-12;
  constexpr int kSteps = 30;
  const CameraIntrinsics& c = intrinsics_;
  const double widest2 = widest_radius_ * widest_radius_;
  for (int i = 0; i < kSteps; ++i) {
    const Eigen::Vector2d error = distort(plane) - distorted;
    if (error.squaredNorm() < kTolerance * kTolerance) return plane;
    const double x = plane.x();
    const double y = plane.y();
    const double r2 = plane.squaredNorm();
    const double radial = radialFactor(c, r2);
    const double slope = 2 * radialFactorSlope(c, r2);
    Eigen::Matrix2d jacobian;
    jacobian(0, 0) = radial + slope * x * x + 2 * c.p1 * y + 6 * c.p2 * x;
    jacobian(0, 1) = slope * x * y + 2 * c.p1 * x + 2 * c.p2 * y;
    jacobian(1, 0) = jacobian(0, 1);
    jacobian(1, 1) = radial + slope * y * y + 6 * c.p1 * y + 2 * c.p2 * x;
    plane -= jacobian.inverse() * error;
    if (!(plane.squaredNorm() <= widest2)) return std::nullopt;
  }
  return std::nullopt;
}

Eigen::Vector2d CameraModel::undistortClosedForm(const Eigen::Vector2d& distorted) const {
  const double r2 = distorted.squaredNorm();
  const auto& [inverse1, inverse2, inverse3] = closed_form_;
  return distorted * (1 + r2 * (inverse1 + r2 * (inverse2 + r2 * inverse3)));  // (5.9-5.11)
}

}  // namespace ardrone_vslam
