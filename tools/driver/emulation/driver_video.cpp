// SPDX-License-Identifier: BSD-3-Clause
#include "driver/emulation/driver_video.hpp"

#include <opencv2/imgproc.hpp>

#include "bags/messages/camera_info.hpp"

namespace ardrone_vslam {
namespace {

/// The same camera with images this many times as wide and high, whose pixels are cut finer.
CameraIntrinsics enlarged(CameraIntrinsics camera, int factor) {
  // The middle of the first pixel is 0, its corner -0.5.
  const auto coordinate = [factor](double c_px) { return (c_px + 0.5) * factor - 0.5; };
  camera.width_px *= factor;
  camera.height_px *= factor;
  camera.fx_px *= factor;
  camera.fy_px *= factor;
  camera.cx_px = coordinate(camera.cx_px);
  camera.cy_px = coordinate(camera.cy_px);
  return camera;
}

bool isStream(const CameraIntrinsics& camera) {
  return camera.width_px == kStreamWidth_px && camera.height_px == kStreamHeight_px;
}

}  // namespace

cv::Mat streamImage(const cv::Mat& grey) {
  cv::Mat stream = grey;
  if (grey.cols != kStreamWidth_px) {
    cv::resize(grey, stream, cv::Size(), 2, 2, cv::INTER_LINEAR);
    const int above_px = (stream.rows - kStreamHeight_px) / 2;
    stream = stream.rowRange(above_px, above_px + kStreamHeight_px);
  }
  cv::Mat rgb;
  cv::cvtColor(stream, rgb, cv::COLOR_GRAY2RGB);
  return rgb;
}

CameraIntrinsics streamCalibration(const CameraIntrinsics& camera) {
  if (isStream(camera)) return camera;
  CameraIntrinsics stream = enlarged(camera, 2);
  stream.cy_px -= (stream.height_px - kStreamHeight_px) / 2.0;
  stream.height_px = kStreamHeight_px;
  return stream;
}

sensor_msgs::CameraInfo streamCameraInfo(const CameraIntrinsics& camera, bool unscaled) {
  CameraIntrinsics calibration = streamCalibration(camera);
  if (unscaled) {
    calibration = isStream(camera) ? enlarged(camera, 2) : camera;
    calibration.width_px = kStreamWidth_px;
    calibration.height_px = kStreamHeight_px;
  }
  return cameraInfoFromIntrinsics(calibration);
}

}  // namespace ardrone_vslam
