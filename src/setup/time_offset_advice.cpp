// SPDX-License-Identifier: BSD-3-Clause
// What is said to users of a time offset.
#include <cmath>
#include <iomanip>
#include <sstream>

#include "ardrone_vslam/time_offset.hpp"

namespace ardrone_vslam {

const char* explain(TimeOffsetState state) {
  switch (state) {
    case TimeOffsetState::kTooFewImages:
      return "too few images with tracks and with odometry around them yet";
    case TimeOffsetState::kTooLittleRotation:
      return "the camera has not turned to and fro enough yet: yaw left and right";
    case TimeOffsetState::kDisagreement:
      return "camera and odometry do not turn alike at any offset: check the camera's mounting "
             "(tf base -> camera), its calibration and the odometry's attitude";
    case TimeOffsetState::kOutOfReach:
      return "the images' stamps and the odometry's are further apart than is looked at: set "
             "image_time_offset_s nearer to it, and check the clocks";
    case TimeOffsetState::kKnown:
      return "";
  }
  return "";
}

bool isOther(const TimeOffset& found, double used_s) {
  constexpr double kSigmas = 3;
  constexpr double kSmallest_s = 0.015;
  const double off_s = std::abs(found.offset_s - used_s);
  return found.state == TimeOffsetState::kKnown && off_s > kSmallest_s &&
         off_s > kSigmas * found.sigma_s;
}

std::string adviceOn(const TimeOffset& found, const NumberOrAuto& told_s, double used_s) {
  const bool is_found = told_s ? isOther(found, used_s) : used_s != 0;
  if (!is_found) return {};
  const double offset_s = told_s ? found.offset_s : used_s;
  std::ostringstream advice;
  advice << std::fixed << std::setprecision(3) << "camera and odometry turn alike when images are "
         << "taken as exposed at their stamps " << (offset_s < 0 ? "- " : "+ ")
         << std::abs(offset_s) << " s";
  if (found.state == TimeOffsetState::kKnown) advice << " (deviation " << found.sigma_s << " s)";
  if (told_s) {
    advice << ", not " << used_s << " s: set image_time_offset_s: " << offset_s;
  } else {
    advice << ": they are, since that was found; with image_time_offset_s: " << offset_s
           << " they are from the first image on";
  }
  return advice.str();
}

}  // namespace ardrone_vslam
