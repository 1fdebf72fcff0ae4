// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "conversions/conversions.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::size_t kDescriptorBytes = sizeof(Descriptor);
constexpr double kBearingTolerance = 1e-3;  // of the norm

std::string sizeFault(const char* name, std::size_t size, std::size_t expected) {
  if (size == expected) return {};
  return text("'", name, "' has ", size, " entries where 'x' asks for ", expected,
              "; fill all arrays alike");
}

/// A position is known along every direction, or not at all.
bool isInformation(const float* xx_xy_yy) {
  const double xx = xx_xy_yy[0];
  const double xy = xx_xy_yy[1];
  const double yy = xx_xy_yy[2];
  const bool is_none = xx == 0 && xy == 0 && yy == 0;
  return is_none || (xx > 0 && yy > 0 && xx * yy > xy * xy && std::isfinite(xx * yy));
}

std::string sizesFault(const Features& m) {
  const std::size_t n = m.x.size();
  for (const auto& fault :
       {sizeFault("y", m.y.size(), n), sizeFault("score", m.score.size(), n),
        sizeFault("track_id", m.track_id.size(), n), sizeFault("age", m.age.size(), n),
        sizeFault("bearing", m.bearing.size(), 3 * n),
        sizeFault("descriptor", m.descriptor.size(), kDescriptorBytes * n),
        sizeFault("information", m.information.size(), m.information.empty() ? 0 : 3 * n),
        sizeFault("residual", m.residual.size(), m.information.empty() ? 0 : n)}) {
    if (!fault.empty()) return fault;
  }
  return {};
}

/// @return the fault
std::string faultOfFeature(const Features& m, std::size_t i) {
  const Eigen::Vector3d bearing(m.bearing[3 * i], m.bearing[3 * i + 1], m.bearing[3 * i + 2]);
  if (!(std::abs(bearing.norm() - 1) < kBearingTolerance)) {
    return text("bearing ", i, " has length ", bearing.norm(), "; unit vectors are asked for");
  }
  if (!m.information.empty() && !isInformation(&m.information[3 * i])) {
    return text("information ", i, " is neither positive definite nor all 0");
  }
  if (!m.residual.empty() && !std::isfinite(m.residual[i])) {
    return text("residual ", i, " is not a finite number");
  }
  if (m.track_id[i] == 0) return text("track_id ", i, " is 0, which is not a track");
  return {};
}

}  // namespace

Checked<OdometryState> toOdometryState(const nav_msgs::Odometry& odometry) {
  auto checked = toUnboundedState(odometry);
  const std::string range_fault = checked.value ? rangeFault(*checked.value) : "";
  if (!range_fault.empty()) return {std::nullopt, range_fault};
  return checked;
}

Checked<RangeReading> toRangeReading(const sensor_msgs::Range& message) {
  if (message.header.stamp.isZero()) return {std::nullopt, "its stamp is zero; set header.stamp"};
  RangeReading reading;
  reading.stamp_ns = toNanoseconds(message.header.stamp);
  reading.range_m = message.range;
  reading.min_m = message.min_range;
  reading.max_m = message.max_range;
  return {reading, {}};
}

Checked<LateCorrection> toLateCorrection(const PoseCorrection& message) {
  if (message.header.stamp.isZero()) return {std::nullopt, "its stamp is zero; set header.stamp"};
  const auto T_odom_base = toIsometry(message.observer_pose);
  if (!T_odom_base.value) return {std::nullopt, "observer_pose: " + T_odom_base.fault};
  const auto T_map_base = toIsometry(message.fused_pose.pose);
  if (!T_map_base.value) return {std::nullopt, "fused_pose: " + T_map_base.fault};
  LateCorrection correction;
  correction.stamp_ns = toNanoseconds(message.header.stamp);
  correction.T_odom_base = *T_odom_base.value;
  correction.T_map_base = *T_map_base.value;
  correction.covariance = toMatrix(message.fused_pose.covariance);
  const std::string fault = faultOf(correction);
  if (!fault.empty()) return {std::nullopt, fault};
  return {correction, {}};
}

std::string faultOf(const Features& m) {
  if (m.header.stamp.isZero()) return "its stamp is zero; set header.stamp to the image's";
  if (m.header.frame_id.empty()) return "it names no frame_id; give the camera's optical frame";
  if (m.width == 0 || m.height == 0) return "its image size is zero; set width and height";
  const double focal_widths = static_cast<double>(m.focal_length) / m.width;
  if (!(focal_widths >= kShortestFocal && focal_widths <= kLongestFocal)) {
    return text("its focal_length is ", m.focal_length, " px; it must be within ", kShortestFocal,
                " and ", kLongestFocal, " times the image width");
  }
  std::string fault = sizesFault(m);
  if (!fault.empty()) return fault;
  if (!allFinite(m.x) || !allFinite(m.y)) return "a pixel position is not finite";
  for (std::size_t i = 0; i < m.x.size(); ++i) {
    std::string feature_fault = faultOfFeature(m, i);
    if (!feature_fault.empty()) return feature_fault;
  }
  return {};
}

void toFeatures(const Features& message, ImageFeatures& features) {
  features.clear();
  features.stamp_ns = toNanoseconds(message.header.stamp);
  features.width_px = static_cast<int>(message.width);
  features.height_px = static_cast<int>(message.height);
  features.focal_length_px = message.focal_length;
  const std::size_t count = message.x.size();
  for (std::size_t i = 0; i < count; ++i) {
    features.pixel_px.emplace_back(message.x[i], message.y[i]);
    features.bearing_cam.emplace_back(message.bearing[3 * i], message.bearing[3 * i + 1],
                                      message.bearing[3 * i + 2]);
  }
  features.score = message.score;
  features.track_id = message.track_id;
  features.age_frames = message.age;
  for (std::size_t i = 0; i + 2 < message.information.size(); i += 3)
    features.information.push_back(
        {message.information[i], message.information[i + 1], message.information[i + 2]});
  features.residual = message.residual;
  features.descriptor.resize(count);
  if (count > 0) {
    std::memcpy(features.descriptor.data(), message.descriptor.data(), count * kDescriptorBytes);
  }
}

Checked<PlaceHint> toPlaceHint(const geometry_msgs::PoseWithCovarianceStamped& message,
                               const std::string& map_frame) {
  if (message.header.frame_id != map_frame)
    return {{},
            text("its frame is '", message.header.frame_id, "' and must be '", map_frame,
                 "'; set rviz's Fixed Frame to that")};
  const auto pose = toIsometry(message.pose.pose);
  if (!pose.value) return {{}, pose.fault};
  const Eigen::Matrix3d R = pose.value->linear();
  PlaceHint hint;
  hint.position_map_m = pose.value->translation().head<2>();
  hint.heading_rad = std::atan2(R(1, 0), R(0, 0));
  const auto takeSigma = [](double variance, double& sigma) {
    if (variance > 0 && std::isfinite(variance)) sigma = std::sqrt(variance);
  };
  const Matrix6d covariance = toMatrix(message.pose.covariance);
  takeSigma(std::max(covariance(0, 0), covariance(1, 1)), hint.position_sigma_m);
  takeSigma(covariance(5, 5), hint.heading_sigma_rad);
  return {hint, {}};
}

}  // namespace ardrone_vslam
