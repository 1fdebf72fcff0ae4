// SPDX-License-Identifier: BSD-3-Clause
#include "camera_info.hpp"

#include <sensor_msgs/distortion_models.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace ardrone_vslam {
namespace {

bool areFinite(const double* begin, const double* end) {
  return std::all_of(begin, end, [](double value) { return std::isfinite(value); });
}

}  // namespace

CameraIntrinsics intrinsicsFromCameraInfo(const sensor_msgs::CameraInfo& info,
                                          const std::string& topic) {
  // Drivers of cameras without distortion leave model and coefficients empty.
  const bool has_no_lens = info.distortion_model.empty() && info.D.empty();
  if (!has_no_lens && info.distortion_model != sensor_msgs::distortion_models::PLUMB_BOB) {
    throw std::runtime_error(topic + ": distortion_model '" + info.distortion_model +
                             "' is not supported; calibrate with plumb_bob (k1, k2, p1, p2, k3), "
                             "or rectify the images first");
  }
  if (info.D.size() != 0 && info.D.size() != 4 && info.D.size() != 5) {
    throw std::runtime_error(topic + ": plumb_bob has " + std::to_string(info.D.size()) +
                             " distortion coefficients, it must have 5 (k1, k2, p1, p2, k3)");
  }
  std::vector<double> d = info.D;
  d.resize(5, 0.0);
  const bool is_calibrated = info.K[0] > 0 && info.K[4] > 0 && info.width > 0 && info.height > 0 &&
                             areFinite(info.K.data(), info.K.data() + info.K.size()) &&
                             areFinite(d.data(), d.data() + d.size());
  if (!is_calibrated) {
    throw std::runtime_error(topic +
                             ": the camera is not calibrated (K, D or the size is zero or not "
                             "finite); calibrate it with camera_calibration");
  }
  if (info.binning_x > 1 || info.binning_y > 1 || info.roi.width > 0 || info.roi.height > 0) {
    throw std::runtime_error(topic +
                             ": binned or cropped images (binning, roi) are not supported; give "
                             "the calibration of the images as they are");
  }
  CameraIntrinsics camera;
  camera.width_px = static_cast<int>(info.width);
  camera.height_px = static_cast<int>(info.height);
  camera.fx_px = info.K[0];
  camera.cx_px = info.K[2];
  camera.fy_px = info.K[4];
  camera.cy_px = info.K[5];
  camera.k1 = d[0];
  camera.k2 = d[1];
  camera.p1 = d[2];
  camera.p2 = d[3];
  camera.k3 = d[4];
  return camera;
}

sensor_msgs::CameraInfo cameraInfoFromIntrinsics(const CameraIntrinsics& camera) {
  sensor_msgs::CameraInfo info;
  info.width = static_cast<std::uint32_t>(camera.width_px);
  info.height = static_cast<std::uint32_t>(camera.height_px);
  info.distortion_model = sensor_msgs::distortion_models::PLUMB_BOB;
  info.D = {camera.k1, camera.k2, camera.p1, camera.p2, camera.k3};
  info.K = {camera.fx_px, 0, camera.cx_px, 0, camera.fy_px, camera.cy_px, 0, 0, 1};
  info.R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  info.P = {camera.fx_px, 0, camera.cx_px, 0, 0, camera.fy_px, camera.cy_px, 0, 0, 0, 1, 0};
  return info;
}

}  // namespace ardrone_vslam
