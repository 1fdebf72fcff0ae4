// SPDX-License-Identifier: BSD-3-Clause
// camera_info: refused with a reason, or a lens whose rays and pixels belong together.
#include "bags/messages/camera_info.hpp"

#include <cmath>

#include "fuzz/ros_bytes.hpp"
#include "with_ros/camera_info_conversion.hpp"

namespace ardrone_vslam::fuzz {
namespace {

void requireRay(const CameraModel& camera, const Eigen::Vector2d& pixel_px) {
  const auto bearing = camera.bearing(pixel_px);
  if (!bearing) return;
  require(bearing->allFinite() && std::abs(bearing->norm() - 1) < 1e-9, "rays are unit vectors");
  const auto pixel = camera.project(*bearing);
  if (pixel) require(pixel->allFinite(), "pixels are finite");
}

void requireCamera(const CameraIntrinsics& intrinsics, bool with_table) {
  require(calibrationFault(intrinsics).empty(), "what is taken has no fault");
  const CameraModel camera(intrinsics);
  require(std::isfinite(camera.focalLength_px()) && camera.focalLength_px() > 0,
          "the focal length is finite");
  for (const double x : {-1e6, -0.5, 0.1, 0.5, 0.9, 1.0, 1e6})
    for (const double y : {0.0, 0.3, 0.5, 1.0})
      requireRay(camera, {x * intrinsics.width_px, y * intrinsics.height_px});
  if (!with_table) return;  // the front end's form, which takes a millisecond
  const CameraModel table(intrinsics, UndistortMethod::kTable);
  requireRay(table, {0.25 * intrinsics.width_px, 0.75 * intrinsics.height_px});
  requireRay(table, {intrinsics.cx_px, intrinsics.cy_px});
}

CameraIntrinsics drone() {
  CameraIntrinsics camera;
  camera.width_px = 640;
  camera.height_px = 360;
  camera.fx_px = 561;
  camera.fy_px = 562;
  camera.cx_px = 320;
  camera.cy_px = 180;
  camera.k1 = -0.5;
  camera.k2 = 0.3;
  camera.p1 = 1e-3;
  return camera;
}

}  // namespace

std::vector<Bytes> seeds() {
  std::vector<Bytes> all;
  const auto add = [&all](std::uint8_t use, const sensor_msgs::CameraInfo& info) {
    Bytes bytes{use};
    const Bytes message = serialized(info);
    bytes.insert(bytes.end(), message.begin(), message.end());
    all.push_back(bytes);
  };
  sensor_msgs::CameraInfo info = cameraInfoFromIntrinsics(drone());
  add(0, info);
  add(1, info);
  add(2 + 4, info);
  info.D.assign(5, 0.0);
  add(0, info);
  info.D.resize(8);
  info.distortion_model = "rational_polynomial";
  add(0, info);
  info.D.clear();
  info.distortion_model.clear();
  info.height = 480;
  add(3, info);
  return all;
}

std::size_t repair(std::uint8_t* /*data*/, std::size_t size, std::size_t /*most_size*/) {
  return size;
}

}  // namespace ardrone_vslam::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ardrone_vslam;
  fuzz::FuzzInput input(data, size);
  const auto use = input.take<std::uint8_t>();
  const auto info = fuzz::deserialized<sensor_msgs::CameraInfo>(input.rest());
  if (!info) return 0;
  const auto camera = toIntrinsics(*info, {(use & 1U) != 0, (use & 2U) != 0});
  fuzz::require(camera.value.has_value() == camera.fault.empty(), "a camera, or a reason");
  if (camera.value) fuzz::requireCamera(*camera.value, (use & 4U) != 0);
  return 0;
}
