// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "ardrone_vslam/flight_record.hpp"
#include "ardrone_vslam/rotation.hpp"

namespace ardrone_vslam::test {

/// What goes wrong in a RecordedFlight; nothing does by default.
struct FlightErrors {
  double corner_px = 0;               ///< sigma of a view
  double wrong_views = 0;             ///< share of views that are of another point
  Eigen::Vector3d bias_m_s{0, 0, 0};  ///< of the odometry, axes of base
  double yaw_rad_per_s = 0;           ///< drift of the odometry
  double scale = 1;                   ///< of the odometry
  double way_m = 0;                   ///< white noise of the odometry a keyframe, per axis
  double height_m = -1;               ///< sigma of heights; negative: there are none
};

/// The record of two laps in a room whose walls are points, and its truth. The odometry is what the
/// fused poses are, so that all of its errors are left to the refinement. On the second lap each
/// point has another track, of the same landmark.
struct RecordedFlight {
  int keyframes;
  static constexpr double kFocal_px = 500;

  FlightRecord record;
  std::vector<Eigen::Isometry3d> truth;
  std::vector<Eigen::Vector3d> points;

  explicit RecordedFlight(const FlightErrors& errors, unsigned seed = 7, int count = 80)
      : keyframes(count), generator_(seed) {
    std::uniform_real_distribution<double> up(-1.5, 1.5);
    for (int i = 0; i < 300; ++i) {
      const double angle = around_(generator_);
      points.emplace_back(5 * std::cos(angle), 5 * std::sin(angle), up(generator_));
    }
    record.config.odometry.velocity_bias_m_s = 0.05;
    record.config.odometry.scale_sigma = 0.1;
    record.config.height.height_sigma_m = 0.01;
    Keyframe keyframe;
    for (int k = 0; k < keyframes; ++k) {
      truth.push_back(poseAt(k));
      follow(errors, keyframe);
      keyframe.views.clear();
      keyframe.landmarks.clear();
      for (std::size_t i = 0; i < points.size(); ++i) addView(errors, i, keyframe);
      if (errors.height_m >= 0)
        keyframe.height_m =
            truth.back().translation().z() + 1 + errors.height_m * normal_(generator_);
      record.keyframes.push_back(keyframe);
    }
  }

  /// Root mean square of the positions' errors.
  double rmse_m(const std::vector<Eigen::Isometry3d>& poses) const {
    double sum_m2 = 0;
    for (std::size_t i = 0; i < poses.size(); ++i)
      sum_m2 += (poses[i].translation() - truth[i].translation()).squaredNorm();
    return std::sqrt(sum_m2 / static_cast<double>(poses.size()));
  }
  std::vector<Eigen::Isometry3d> before() const {
    std::vector<Eigen::Isometry3d> poses;
    for (const Keyframe& keyframe : record.keyframes) poses.push_back(keyframe.T_map_base);
    return poses;
  }

 private:
  static constexpr double kStep_s = 0.5;

  std::mt19937 generator_;
  std::uniform_real_distribution<double> around_{-M_PI, M_PI};
  std::normal_distribution<double> normal_{0, 1};

  void addView(const FlightErrors& errors, std::size_t point, Keyframe& keyframe) {
    std::uniform_real_distribution<double> share(0, 1);
    const bool is_wrong = share(generator_) < errors.wrong_views;
    const Eigen::Vector3d seen = (truth.back() * keyframe.T_base_cam).inverse() * points[point];
    const Eigen::Vector3d noise(normal_(generator_), normal_(generator_), 0);
    const Eigen::Vector3d wrong(0.04 * around_(generator_), 0.04 * around_(generator_), 0);
    Eigen::Vector3d pixel = seen / seen.z() + errors.corner_px / kFocal_px * noise;
    if (seen.z() < 0 || std::abs(pixel.x()) > 0.8 || std::abs(pixel.y()) > 0.6) return;
    if (is_wrong) pixel += wrong;
    const std::size_t lap =
        record.keyframes.size() < static_cast<std::size_t>(keyframes) / 2 ? 0 : 1;
    KeyframeView view;
    view.track_id = static_cast<std::uint32_t>(1 + point + lap * points.size());
    view.bearing_cam = pixel.normalized().cast<float>();
    view.information_rad2 = Eigen::Matrix2f::Identity() * 1e6F;  // half a pixel
    keyframe.landmarks.push_back({view.track_id, static_cast<std::uint32_t>(point + 1)});
    keyframe.views.push_back(view);
  }

  /// Two laps around the origin, up and down, looking outwards and ahead.
  Eigen::Isometry3d poseAt(int k) const {
    const double angle = 4 * M_PI * k / keyframes;
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.translation() << 1.5 * std::cos(angle) - 1.5, 1.5 * std::sin(angle),
        0.4 * std::sin(1.5 * angle);
    T.linear() = rotationAboutZ(angle);
    return T;
  }

  void follow(const FlightErrors& errors, Keyframe& keyframe) {
    const std::size_t k = record.keyframes.size();
    keyframe.stamp_ns = 1'000'000'000 + static_cast<std::int64_t>(k * 500'000'000);
    keyframe.focal_length_px = kFocal_px;
    keyframe.T_base_cam.translation() << 0.1, 0, 0;
    keyframe.T_base_cam.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;  // ahead
    const Eigen::Matrix3d drift =
        rotationAboutZ(errors.yaw_rad_per_s * kStep_s * static_cast<double>(k));
    if (k > 0) {
      const Eigen::Vector3d way_m = truth[k].translation() - truth[k - 1].translation();
      const Eigen::Vector3d bias_m = truth[k - 1].linear() * errors.bias_m_s * kStep_s;
      keyframe.T_odom_base.translation() += drift * (errors.scale * way_m + bias_m);
      for (double& x_m : keyframe.T_odom_base.translation())
        x_m += errors.way_m * normal_(generator_);
      keyframe.way_variance_m2 = 1e-4;
      keyframe.way_m = way_m.norm();
    }
    keyframe.T_odom_base.linear() = drift * truth[k].linear();
    keyframe.T_map_base = keyframe.T_odom_base;
  }
};

}  // namespace ardrone_vslam::test
