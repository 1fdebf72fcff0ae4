// SPDX-License-Identifier: BSD-3-Clause
// What is said to users of a fault of the set-up.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iomanip>
#include <sstream>

#include "ardrone_vslam/rotation.hpp"
#include "ardrone_vslam/setup_watch.hpp"
#include "linear/portable_math.hpp"

namespace ardrone_vslam {
namespace {

/// Of the fault itself, without what helps.
const char* causeOf(SetupFault fault) {
  switch (fault) {
    case SetupFault::kNone:
      break;
    case SetupFault::kExtrinsics:
      return "the camera is turned otherwise than tf says";
    case SetupFault::kMirrored:
      return "the images are mirrored";
    case SetupFault::kTimeOffset:
      return "the images' stamps are off";
    case SetupFault::kFocalLength:
      return "the calibration's focal length is wrong";
    case SetupFault::kOdometryPosition:
      return "the odometry's x and y are integrated with the yaw mirrored";
    case SetupFault::kOdometryYaw:
      return "the odometry's yaw is mirrored";
    case SetupFault::kStillImages:
      return "the odometry turns, the images stand still";
    case SetupFault::kUnknown:
      return "no mounting, time offset or focal length explains it";
  }
  return "";
}

std::string remedyOf(const SetupFinding& finding, const std::string& base,
                     const std::string& camera) {
  std::ostringstream remedy;
  remedy << std::fixed << std::setprecision(2);
  switch (finding.fault) {
    case SetupFault::kNone:
      break;
    case SetupFault::kExtrinsics:
      remedy << "correct it: " << staticTransformLine(finding.T_base_cam, base, camera);
      break;
    case SetupFault::kMirrored:
      remedy << "switch that off in the camera's driver";
      break;
    case SetupFault::kTimeOffset:
      remedy << "set image_time_offset_s: " << finding.offset_s
             << ", or mend the clocks; the value is told more exactly once it is about right";
      break;
    case SetupFault::kFocalLength:
      remedy << "it is about " << std::setprecision(1) << finding.focal_factor
             << " times the true one: calibrate the camera at the size of its images";
      break;
    case SetupFault::kOdometryPosition:
      remedy << "ardrone_autonomy does that: set odometry_mode to twist";
      break;
    case SetupFault::kOdometryYaw:
      remedy << "it must grow counter-clockwise (REP-103): mend its driver";
      break;
    case SetupFault::kStillImages:
      remedy
          << "does the driver send one image again and again, or does something on the robot fill "
             "the view? Restart the camera's driver, free the view";
      break;
    case SetupFault::kUnknown:
      remedy << "are images and odometry of one vehicle and one time? Is the calibration that of "
                "this camera? Does most of what is seen move? Record a bag and ask doctor";
      break;
  }
  return remedy.str();
}

}  // namespace

std::string explain(const SetupFinding& finding, const std::string& base,
                    const std::string& camera) {
  if (finding.fault == SetupFault::kNone) return {};
  std::string text = "camera and odometry contradict each other, so the pose is the odometry's: ";
  text += causeOf(finding.fault);
  if (finding.rival == SetupFault::kNone) return text + "; " + remedyOf(finding, base, camera);
  // Which of them must not be told too early.
  if (finding.rival == finding.fault)
    return text + "; how is told by more motion: turn, and fly about";
  return text + ", or " + causeOf(finding.rival) + "; more motion tells: turn, and fly about";
}

std::string staticTransformLine(const Eigen::Isometry3d& T_base_cam, const std::string& base,
                                const std::string& camera) {
  // Fixed axes roll, pitch, yaw: R = Rz(yaw) Ry(pitch) Rx(roll).
  const Eigen::Matrix3d& R = T_base_cam.linear();
  const double pitch = portable::atan2(-R(2, 0), portable::hypot(R(0, 0), R(1, 0)));
  const bool is_steep = std::abs(R(2, 0)) > 1 - 1e-9;  // yaw and roll about one axis: all is roll
  const double yaw = is_steep ? 0 : yawOf(R);
  const double roll =
      is_steep ? portable::atan2(-R(0, 1) * R(2, 0), R(1, 1)) : portable::atan2(R(2, 1), R(2, 2));
  const Eigen::Vector3d& t = T_base_cam.translation();
  const auto round = [](double value) { return std::round(value * 1e5) / 1e5 + 0.0; };
  std::array<char, 160> numbers{};
  std::snprintf(numbers.data(), numbers.size(), "%g %g %g %g %g %g", round(t.x()), round(t.y()),
                round(t.z()), round(yaw), round(pitch), round(roll));
  return std::string("rosrun tf2_ros static_transform_publisher ") + numbers.data() + " " + base +
         " " + camera;
}

}  // namespace ardrone_vslam
