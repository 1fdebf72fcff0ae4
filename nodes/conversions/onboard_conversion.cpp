// SPDX-License-Identifier: BSD-3-Clause
#include "conversions/onboard_conversion.hpp"

#include <cmath>

#include "conversions/conversions.hpp"

namespace ardrone_vslam {
namespace {

static_assert(kSlamStateNames.size() == VSLAM_LAST_STATE + 1, "the states of the two are the same");

Eigen::Isometry3d toIsometry(const double (&position_m)[3], const double (&quaternion)[4]) {
  const Eigen::Quaterniond q(quaternion[3], quaternion[0], quaternion[1], quaternion[2]);
  return Eigen::Translation3d(position_m[0], position_m[1], position_m[2]) * q.normalized();
}

LeftOut leftOutOf(const VslamPose& pose) {
  return LeftOut(pose.flags / VSLAM_POSE_WITHOUT_PLACE_SEARCH);  // higher bits are cut off
}

void setState(std::uint8_t state, const char* name, const char* reason, Status& status) {
  status.state = state;
  status.state_name = name;
  status.reason = reason;
}

}  // namespace

FrameResult toFrameResult(const VslamPose& pose, std::int64_t stamp_ns) {
  FrameResult result;
  result.stamp_ns = stamp_ns;
  result.state = static_cast<SlamState>(pose.state);
  result.T_map_base = toIsometry(pose.position_m, pose.quaternion);
  result.T_odom_base = toIsometry(pose.observer_position_m, pose.observer_quaternion);
  for (int i = 0; i < 6; ++i) result.covariance(i, i) = pose.deviation[i] * pose.deviation[i];
  result.sigma_m = std::sqrt(result.covariance.topLeftCorner<3, 3>().trace() / 3);
  result.landmarks = static_cast<int>(pose.landmarks);
  result.left_out = leftOutOf(pose);
  return result;
}

void toStatus(const VslamPose& pose, Status& status) {
  switch (pose.state) {
    case VSLAM_WAITING_FOR_IMAGES:
      setState(Status::WAITING_FOR_FEATURES, "waiting_for_features",
               "vslam_onboard has had no image yet: its own output says what its camera lacks",
               status);
      break;
    case VSLAM_CAMERA_LOST:
      setState(Status::CAMERA_LOST, "camera_lost",
               "vslam_onboard's camera is missing, gone or silent: does `frames` name it, and is "
               "the stock controller stopped, which holds the cameras? It is opened again every "
               "second",
               status);
      break;
    case VSLAM_CONTROLLER_SILENT:
      setState(Status::CONTROLLER_SILENT, "controller_silent",
               "vslam_onboard gets no good record of the flight controller: does that run, and "
               "send to its `observer` (ADDRESS:PORT)?",
               status);
      break;
    case VSLAM_NO_OBSERVER:
      setState(Status::WAITING_FOR_ODOMETRY, "waiting_for_odometry",
               "the flight controller's records come, but none for the images' stamps: both must "
               "be of one clock (`realtime_clock`), and come within `odometry_wait_s`",
               status);
      break;
    case VSLAM_OUT_OF_MEMORY:
      setState(Status::OUT_OF_MEMORY, "out_of_memory",
               "the memory that vslam_onboard took at its start does not suffice, and the map "
               "begins anew: raise `working_mb`",
               status);
      break;
    case VSLAM_ENDING:
      setState(Status::ENDED, "ended", "vslam_onboard has ended: it was stopped, or its images end",
               status);
      break;
    default:
      toStatus(static_cast<SlamState>(pose.state), leftOutOf(pose), status);
      sayFirst(explain(leftOutOf(pose)), status);
  }
  status.landmarks = pose.landmarks;
  status.images_dropped = pose.frames_dropped;
  status.odometry_refused = pose.records_dropped;
}

std::size_t addBearings(const CameraModel& camera, ImageFeatures& features) {
  features.width_px = camera.intrinsics().width_px;
  features.height_px = camera.intrinsics().height_px;
  features.focal_length_px = static_cast<float>(camera.focalLength_px());
  const std::size_t count = features.size();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector2d pixel_px = features.pixel_px[i].cast<double>();
    const auto bearing = camera.isInImage(pixel_px) ? camera.bearing(pixel_px) : std::nullopt;
    if (!bearing) continue;
    features.bearing_cam.emplace_back(bearing->cast<float>());
    features.pixel_px[kept] = features.pixel_px[i];
    features.age_frames[kept] = features.age_frames[i];
    ++kept;
  }
  features.pixel_px.resize(kept);
  features.age_frames.resize(kept);
  return count - kept;
}

}  // namespace ardrone_vslam
