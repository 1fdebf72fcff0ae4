// SPDX-License-Identifier: BSD-3-Clause
#include "bags/messages/camera_info.hpp"

#include <sensor_msgs/distortion_models.h>

#include <stdexcept>

namespace ardrone_vslam {
CameraIntrinsics intrinsicsFromCameraInfo(const sensor_msgs::CameraInfo& info,
                                          const std::string& topic, const CameraInfoUse& use) {
  const Checked<CameraIntrinsics> checked = toIntrinsics(info, use);
  if (!checked.value) throw std::runtime_error(topic + ": " + checked.fault);
  return *checked.value;
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
