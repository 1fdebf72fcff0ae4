// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "ardrone_vslam/features.hpp"
#include "ardrone_vslam/rotation.hpp"
#include "doctor/recording/doctor_recording.hpp"
#include "sequences/sequence.hpp"
#include "support/intrinsics.hpp"

namespace ardrone_vslam::test {

constexpr std::int64_t kDoctorBegin_ns = 1'400'000'000'000'000'000;

inline std::int64_t doctorStamp_ns(double t_s) {
  return kDoctorBegin_ns + static_cast<std::int64_t>(std::llround(t_s * 1e9));
}

/// A flight that turns, tilts and climbs: a circle of 2 m in 10 s.
inline Eigen::Isometry3d doctorPose(double t_s) {
  const double turn = 2 * M_PI * t_s / 10;
  Eigen::Isometry3d T_odom_base = Eigen::Isometry3d::Identity();
  T_odom_base.translation() << 2 * std::cos(turn), 2 * std::sin(turn), 1.2 + 0.3 * std::sin(t_s);
  T_odom_base.linear() = rotationOf({0, 0, turn + M_PI / 2 + 0.3 * std::sin(2 * t_s)}) *
                         rotationOf({0.1 * std::sin(3 * t_s), 0.1 * std::cos(2.3 * t_s), 0});
  return T_odom_base;
}

inline OdometryState doctorState(double t_s) {
  constexpr double kStep_s = 1e-4;
  OdometryState state;
  state.stamp_ns = doctorStamp_ns(t_s);
  state.T_odom_base = doctorPose(t_s);
  const Eigen::Isometry3d before = doctorPose(t_s - kStep_s), after = doctorPose(t_s + kStep_s);
  const Eigen::Matrix3d R_base_odom = state.T_odom_base.linear().transpose();
  state.twist_base.head<3>() =
      R_base_odom * (after.translation() - before.translation()) / (2 * kStep_s);
  state.twist_base.tail<3>() =
      rotationVectorOf(before.linear().transpose() * after.linear()) / (2 * kStep_s);
  state.covariance.setIdentity();
  return state;
}

inline CameraIntrinsics doctorCamera() {
  return test::pinhole(640, 360, 570);
}

/// All as it should be: 12 s, 10 images and 100 odometry messages a second. Without pixels.
inline DoctorRecording goodRecording() {
  DoctorRecording recording;
  recording.name = "good.bag";
  recording.topics = {{"/cam/image_raw", {"sensor_msgs/Image", 120}},
                      {"/cam/camera_info", {"sensor_msgs/CameraInfo", 120}},
                      {"/odom", {"nav_msgs/Odometry", 1200}}};
  recording.image_topic = "/cam/image_raw";
  recording.camera_info_topic = "/cam/camera_info";
  recording.odometry_topic = "/odom";
  recording.odom_frame = "odom";
  recording.base_frame = "base";
  recording.calibrations = {{doctorCamera(), {}}};
  for (int i = 0; i < 120; ++i) {
    const std::int64_t stamp_ns = doctorStamp_ns(0.1 * i);
    recording.images.push_back({{stamp_ns, stamp_ns}, "cam", 640, 360, {}});
    recording.camera_infos.push_back({{stamp_ns, stamp_ns}, 0});
  }
  for (int i = 0; i < 1200; ++i) {
    const OdometryState state = doctorState(0.01 * i);
    recording.odometry.push_back({{state.stamp_ns, state.stamp_ns}, state});
  }
  recording.transforms["base"] = {"odom", doctorPose(0), {}};
  recording.transforms["cam"] = {"base", forwardCamera(), {}};
  recording.grey = [](std::size_t) { return cv::Mat(); };
  return recording;
}

/// On walls, floor and ceiling of a room of 9 x 9 x 4 m.
inline std::vector<Eigen::Vector3d> pointsOfRoom(std::mt19937& random,
                                                 std::uniform_real_distribution<double>& uniform) {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 1500; ++i) {
    Eigen::Vector3d point(4.5 * uniform(random), 4.5 * uniform(random), 1.5 + 2 * uniform(random));
    const bool is_even = i % 2 == 0;
    if (i % 3 == 2) point.z() = is_even ? -0.5 : 3.5;
    if (i % 3 != 2) point[i % 3] = is_even ? -4.5 : 4.5;
    points.push_back(point);
  }
  return points;
}

/// The camera's view of points on the walls of a room, at the images' stamps plus `late_s` seen
/// at these stamps.
inline std::vector<ImageFeatures> doctorViews(const Eigen::Isometry3d& T_base_cam,
                                              double late_s = 0, double seconds = 12) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const std::vector<Eigen::Vector3d> points = pointsOfRoom(random, uniform);
  const CameraModel camera(doctorCamera());
  std::vector<ImageFeatures> images;
  for (double t_s = 0; t_s < seconds; t_s += 0.1) {
    ImageFeatures features;
    features.stamp_ns = doctorStamp_ns(t_s + late_s);
    features.focal_length_px = 570;
    const Eigen::Isometry3d T_cam_odom = (doctorPose(t_s) * T_base_cam).inverse();
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Eigen::Vector3d point_cam = T_cam_odom * points[i];
      const auto pixel = camera.project(point_cam);
      if (!pixel || !camera.isInImage(*pixel)) continue;
      const Eigen::Vector2d noisy =
          *pixel + 0.5 * Eigen::Vector2d(uniform(random), uniform(random));
      const auto bearing = camera.bearing(noisy);
      if (!bearing) continue;
      features.pixel_px.push_back(noisy.cast<float>());
      features.bearing_cam.push_back(bearing->cast<float>());
      features.track_id.push_back(static_cast<std::uint32_t>(i + 1));
    }
    images.push_back(features);
  }
  return images;
}

}  // namespace ardrone_vslam::test
