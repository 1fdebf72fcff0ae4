// SPDX-License-Identifier: BSD-3-Clause
#include "with_ros/camera_info_conversion.hpp"

namespace ardrone_vslam {
namespace {

/// Fills k1, k2, p1, p2, k3. @return the fault
std::string readDistortion(const sensor_msgs::CameraInfo& info, CameraIntrinsics& camera) {
  const auto& d = info.D;
  const std::string& model = info.distortion_model;
  const std::string remedy =
      "; calibrate with plumb_bob (camera_calibration's default), or rectify the images and set "
      "the parameter rectified";
  if (!allFinite(d)) return "camera_info's D is not finite; calibrate the camera anew";
  if (model.empty() && d.empty()) return {};
  if (model.empty()) return "camera_info has a D but no distortion_model" + remedy;
  if (model != "plumb_bob" && model != "rational_polynomial") {
    return "the lens model '" + model + "' is not supported" + remedy;
  }
  for (std::size_t i = 5; i < d.size(); ++i) {
    if (d[i] != 0) {
      return text("the lens model '", model, "' with ", d.size(), " coefficients (D[", i, "] is ",
                  d[i], ") is not supported", remedy);
    }
  }
  if (!d.empty() && d.size() < 4) {
    return text("camera_info's D has ", d.size(), " values where ", model, " has 5", remedy);
  }
  const auto coefficient = [&d](std::size_t i) { return i < d.size() ? d[i] : 0.0; };
  camera.k1 = coefficient(0);
  camera.k2 = coefficient(1);
  camera.p1 = coefficient(2);
  camera.p2 = coefficient(3);
  camera.k3 = coefficient(4);
  return {};
}

/// What the intrinsics themselves tell: uncalibrated, or for another image size. @return the fault
std::string faultOf(const CameraIntrinsics& c, const char* matrix) {
  if (!(std::isfinite(c.fx_px) && std::isfinite(c.fy_px) && std::isfinite(c.cx_px) &&
        std::isfinite(c.cy_px))) {
    return text("camera_info's ", matrix, " is not finite; calibrate the camera anew");
  }
  if (c.fx_px <= 0 || c.fy_px <= 0) {
    return text("the camera is uncalibrated (camera_info's ", matrix,
                " has no focal length above zero); calibrate it with camera_calibration and give "
                "the driver the file");
  }
  if (c.width_px <= 0 || c.height_px <= 0) {
    return text("camera_info says an image size of ", c.width_px, "x", c.height_px,
                "; set its width and height");
  }
  if (c.cx_px < 0 || c.cx_px >= c.width_px || c.cy_px < 0 || c.cy_px >= c.height_px) {
    return text("camera_info's principal point (", c.cx_px, ", ", c.cy_px,
                ") lies outside its image of ", c.width_px, "x", c.height_px,
                ": the calibration is for another image size; calibrate at this one, or set "
                "rescale_calibration to true");
  }
  return {};
}

/// @return the calibration for images of width_px x height_px
CameraIntrinsics rescaled(const CameraIntrinsics& calibration) {
  const double size = std::round(std::log2(2 * calibration.cx_px / calibration.width_px));
  if (!std::isfinite(size) || size == 0) return calibration;
  const double scale = std::exp2(-size);
  CameraIntrinsics camera = calibration;
  camera.fx_px *= scale;
  camera.fy_px *= scale;
  camera.cx_px = (camera.cx_px + 0.5) * scale - 0.5;
  camera.cy_px = (camera.cy_px + 0.5) * scale - 0.5;
  // Images of 4:3, scaled to the width, are too high for those of 16:9.
  const double cut_px = (0.75 * camera.width_px - camera.height_px) / 2;
  const double middle_px = 0.5 * camera.height_px;
  if (std::abs(camera.cy_px - cut_px - middle_px) < std::abs(camera.cy_px - middle_px))
    camera.cy_px -= cut_px;
  return camera;
}

/// A full roi and one of zeros both stand for the whole image (CameraInfo.msg). @return the fault
std::string croppingFault(const sensor_msgs::CameraInfo& info) {
  if (info.binning_x > 1 || info.binning_y > 1) {
    return "camera_info says binning, which is not supported; publish images at full resolution";
  }
  const auto& roi = info.roi;
  const bool is_unset = roi.width == 0 && roi.height == 0;
  const bool is_full = roi.width == info.width && roi.height == info.height;
  if ((!is_unset && !is_full) || roi.x_offset != 0 || roi.y_offset != 0) {
    return text("camera_info says a region of interest (roi) of ", roi.width, "x", roi.height,
                " at (", roi.x_offset, ", ", roi.y_offset,
                "), which is not supported; publish whole images");
  }
  return {};
}

}  // namespace

Checked<CameraIntrinsics> toIntrinsics(const sensor_msgs::CameraInfo& info,
                                       const CameraInfoUse& use) {
  CameraIntrinsics camera;
  camera.width_px = static_cast<int>(info.width);
  camera.height_px = static_cast<int>(info.height);
  const auto at = [&](std::size_t in_k, std::size_t in_p) {
    return use.rectified ? info.P[in_p] : info.K[in_k];
  };
  camera.fx_px = at(0, 0);
  camera.cx_px = at(2, 2);
  camera.fy_px = at(4, 5);
  camera.cy_px = at(5, 6);
  if (use.rescale) camera = rescaled(camera);
  std::string fault = faultOf(camera, use.rectified ? "P" : "K");
  if (fault.empty()) fault = croppingFault(info);
  if (fault.empty() && !use.rectified) fault = readDistortion(info, camera);
  if (fault.empty()) fault = calibrationFault(camera);
  if (!fault.empty()) return {std::nullopt, fault};
  return {camera, {}};
}

}  // namespace ardrone_vslam
