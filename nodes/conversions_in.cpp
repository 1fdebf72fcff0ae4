// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cmath>
#include <cstring>
#include <sstream>

#include "conversions.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::size_t kDescriptorBytes = sizeof(Descriptor);
constexpr double kQuaternionTolerance = 0.1;  // of the norm; drivers round to a few digits
constexpr double kBearingTolerance = 1e-3;    // of the norm

template <class... Parts>
std::string text(const Parts&... parts) {
  std::ostringstream stream;
  (stream << ... << parts);
  return stream.str();
}

template <class Numbers>
bool allFinite(const Numbers& numbers) {
  for (const auto number : numbers) {
    if (!std::isfinite(number)) return false;
  }
  return true;
}

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
  if (c.fx_px == 0 || c.fy_px == 0) {
    return text("the camera is uncalibrated (camera_info's ", matrix,
                " is zero); calibrate it with camera_calibration and give the driver the file");
  }
  if (c.width_px <= 0 || c.height_px <= 0) {
    return text("camera_info says an image size of ", c.width_px, "x", c.height_px,
                "; set its width and height");
  }
  if (c.cx_px < 0 || c.cx_px >= c.width_px || c.cy_px < 0 || c.cy_px >= c.height_px) {
    return text("camera_info's principal point (", c.cx_px, ", ", c.cy_px,
                ") lies outside its image of ", c.width_px, "x", c.height_px,
                ": the calibration is for another image size; calibrate at this one");
  }
  return {};
}

std::string sizeFault(const char* name, std::size_t size, std::size_t expected) {
  if (size == expected) return {};
  return text("'", name, "' has ", size, " entries where 'x' asks for ", expected,
              "; fill all arrays alike");
}

std::string sizesFault(const Features& m) {
  const std::size_t n = m.x.size();
  for (const auto& fault :
       {sizeFault("y", m.y.size(), n), sizeFault("score", m.score.size(), n),
        sizeFault("track_id", m.track_id.size(), n), sizeFault("age", m.age.size(), n),
        sizeFault("bearing", m.bearing.size(), 3 * n),
        sizeFault("descriptor", m.descriptor.size(), kDescriptorBytes * n)}) {
    if (!fault.empty()) return fault;
  }
  return {};
}

/// @return the fault
std::string faultOf(const geometry_msgs::TwistWithCovariance& twist) {
  const auto& v = twist.twist.linear;
  const auto& w = twist.twist.angular;
  if (!allFinite(std::array<double, 6>{v.x, v.y, v.z, w.x, w.y, w.z})) {
    return "its twist is not finite; zeros stand for 'unknown'";
  }
  if (!allFinite(twist.covariance)) {
    return "its twist covariance is not finite; all zeros stand for 'unknown'";
  }
  return {};
}

}  // namespace

std::int64_t toNanoseconds(const ros::Time& time) {
  return static_cast<std::int64_t>(time.toNSec());
}

ros::Time toRosTime(std::int64_t stamp_ns) {
  ros::Time time;
  return time.fromNSec(static_cast<std::uint64_t>(stamp_ns));
}

Checked<CameraIntrinsics> toIntrinsics(const sensor_msgs::CameraInfo& info, bool rectified) {
  CameraIntrinsics camera;
  camera.width_px = static_cast<int>(info.width);
  camera.height_px = static_cast<int>(info.height);
  const auto at = [&](std::size_t in_k, std::size_t in_p) {
    return rectified ? info.P[in_p] : info.K[in_k];
  };
  camera.fx_px = at(0, 0);
  camera.cx_px = at(2, 2);
  camera.fy_px = at(4, 5);
  camera.cy_px = at(5, 6);
  std::string fault = faultOf(camera, rectified ? "P" : "K");
  if (fault.empty() && (info.binning_x > 1 || info.binning_y > 1)) {
    fault = "camera_info says binning, which is not supported; publish images at full resolution";
  }
  if (fault.empty() && !rectified) fault = readDistortion(info, camera);
  if (!fault.empty()) return {std::nullopt, fault};
  return {camera, {}};
}

Checked<ObserverState> toObserverState(const nav_msgs::Odometry& odometry) {
  const auto& pose = odometry.pose.pose;
  const Eigen::Vector3d p(pose.position.x, pose.position.y, pose.position.z);
  const Eigen::Quaterniond q(pose.orientation.w, pose.orientation.x, pose.orientation.y,
                             pose.orientation.z);
  const auto& covariance = odometry.pose.covariance;
  if (!p.allFinite()) return {std::nullopt, "its position is not finite"};
  if (!q.coeffs().allFinite()) return {std::nullopt, "its orientation is not finite"};
  if (!(std::abs(q.norm() - 1) < kQuaternionTolerance)) {
    return {std::nullopt, text("its orientation has norm ", q.norm(),
                               " where a unit quaternion is asked for; fill the orientation")};
  }
  if (!allFinite(covariance)) {
    return {std::nullopt, "its pose covariance is not finite; all zeros stand for 'unknown'"};
  }
  // The map has no use for the twist, but the fused odometry passes it on to controllers.
  const std::string twist_fault = faultOf(odometry.twist);
  if (!twist_fault.empty()) return {std::nullopt, twist_fault};
  ObserverState state;
  for (int i = 0; i < 6; ++i) {
    if (covariance[static_cast<std::size_t>(7 * i)] < 0) {
      return {std::nullopt, text("its pose covariance has the negative variance ",
                                 covariance[static_cast<std::size_t>(7 * i)], " at row ", i,
                                 "; all zeros stand for 'unknown'")};
    }
  }
  if (odometry.header.stamp.isZero()) return {std::nullopt, "its stamp is zero; set header.stamp"};
  state.stamp_ns = toNanoseconds(odometry.header.stamp);
  state.T_odom_base.translation() = p;
  state.T_odom_base.linear() = q.normalized().toRotationMatrix();
  state.covariance =
      Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(covariance.data());
  return {state, {}};
}

std::string faultOf(const Features& m) {
  if (m.header.stamp.isZero()) return "its stamp is zero; set header.stamp to the image's";
  if (m.header.frame_id.empty()) return "it names no frame_id; give the camera's optical frame";
  if (m.width == 0 || m.height == 0) return "its image size is zero; set width and height";
  if (!(std::isfinite(m.focal_length) && m.focal_length > 0)) {
    return text("its focal_length is ", m.focal_length, " px; it must be above zero");
  }
  std::string fault = sizesFault(m);
  if (!fault.empty()) return fault;
  if (!allFinite(m.x) || !allFinite(m.y)) return "a pixel position is not finite";
  for (std::size_t i = 0; i < m.x.size(); ++i) {
    const Eigen::Vector3d bearing(m.bearing[3 * i], m.bearing[3 * i + 1], m.bearing[3 * i + 2]);
    if (!(std::abs(bearing.norm() - 1) < kBearingTolerance)) {
      return text("bearing ", i, " has length ", bearing.norm(), "; unit vectors are asked for");
    }
    if (m.track_id[i] == 0) return text("track_id ", i, " is 0, which is not a track");
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
  features.descriptor.resize(count);
  if (count > 0) {
    std::memcpy(features.descriptor.data(), message.descriptor.data(), count * kDescriptorBytes);
  }
}

}  // namespace ardrone_vslam
