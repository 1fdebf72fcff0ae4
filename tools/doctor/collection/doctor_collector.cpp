// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/collection/doctor_collector.hpp"

#include <algorithm>

#include "bags/bag_poses.hpp"
#include "bags/messages/bag_messages.hpp"
#include "bags/messages/grey_image.hpp"
#include "with_ros/camera_info_conversion.hpp"
#include "with_ros/navdata_conversion.hpp"

namespace ardrone_vslam {
namespace {

/// As it stands there, for messages.
CameraIntrinsics rawIntrinsics(const sensor_msgs::CameraInfo& info) {
  CameraIntrinsics camera;
  camera.width_px = static_cast<int>(info.width);
  camera.height_px = static_cast<int>(info.height);
  camera.fx_px = info.K[0];
  camera.fy_px = info.K[4];
  camera.cx_px = info.K[2];
  camera.cy_px = info.K[5];
  return camera;
}

}  // namespace

void DoctorCollector::see(const sensor_msgs::Image& message, std::int64_t received_ns) {
  DoctorImage image;
  image.time = {toNanoseconds(message.header.stamp), received_ns};
  image.frame = withoutSlash(message.header.frame_id);
  image.width_px = static_cast<int>(message.width);
  image.height_px = static_cast<int>(message.height);
  if (!isSupportedEncoding(message.encoding)) {
    image.fault = "the encoding '" + message.encoding + "' is not supported";
  } else if (!isWhole(message)) {
    image.fault = "fewer bytes than its size says";
  }
  recording_.images.push_back(image);
}

void DoctorCollector::see(const sensor_msgs::CompressedImage& message, const cv::Size& size_px,
                          std::int64_t received_ns) {
  DoctorImage image;
  image.time = {toNanoseconds(message.header.stamp), received_ns};
  image.frame = withoutSlash(message.header.frame_id);
  image.width_px = size_px.width;
  image.height_px = size_px.height;
  if (size_px.area() == 0) image.fault = "cut off or not to be decoded";
  recording_.images.push_back(image);
}

void DoctorCollector::see(const sensor_msgs::CameraInfo& message, std::int64_t received_ns) {
  const Checked<CameraIntrinsics> checked = toIntrinsics(message);
  DoctorCalibration calibration;
  calibration.camera = checked.value.value_or(rawIntrinsics(message));
  calibration.fault = checked.fault;
  CameraInfoUse rescaling;
  rescaling.rescale = true;
  calibration.rescaled = toIntrinsics(message, rescaling).value;
  auto& known = recording_.calibrations;
  auto same = std::find(known.begin(), known.end(), calibration);
  if (same == known.end()) same = known.insert(known.end(), calibration);
  recording_.camera_infos.push_back({{toNanoseconds(message.header.stamp), received_ns},
                                     static_cast<std::size_t>(same - known.begin())});
}

void DoctorCollector::see(const nav_msgs::Odometry& message, std::int64_t received_ns) {
  if (recording_.odometry.empty()) {
    recording_.odom_frame = withoutSlash(message.header.frame_id);
    recording_.base_frame = withoutSlash(message.child_frame_id);
  }
  recording_.odometry.push_back(
      {{toNanoseconds(message.header.stamp), received_ns}, toUnboundedState(message).value});
}

void DoctorCollector::see(const Navdata& message, std::int64_t received_ns) {
  if (isNavdataTheOdometry(recording_) && recording_.navdata.empty())
    recording_.base_frame = withoutSlash(message.header.frame_id);
  recording_.navdata.push_back(
      {{toNanoseconds(message.header.stamp), received_ns}, toNavdataReading(message).value});
}

void DoctorCollector::see(const sensor_msgs::Imu& message, std::int64_t received_ns) {
  recording_.imu.push_back(
      {{toNanoseconds(message.header.stamp), received_ns}, toDroneImu(message).value});
}

void DoctorCollector::see(const tf2_msgs::TFMessage& message) {
  for (const geometry_msgs::TransformStamped& transform : message.transforms) {
    const auto T_parent_child = toIsometry(transform.transform).value;
    if (!T_parent_child) continue;
    DoctorTransform& edge = recording_.transforms[withoutSlash(transform.child_frame_id)];
    const std::string parent = withoutSlash(transform.header.frame_id);
    if (!edge.parent.empty() && edge.parent != parent) edge.other_parent = edge.parent;
    edge.parent = parent;
    edge.T_parent_child = *T_parent_child;
  }
}

}  // namespace ardrone_vslam
