// SPDX-License-Identifier: BSD-3-Clause
#include "input_checks/standstill_watch.hpp"

#include <algorithm>

namespace ardrone_vslam {
namespace {

constexpr std::int64_t kWindow_ns = 500'000'000;  // tracks that last no longer are enough
constexpr double kExplained = 0.5;  // share of the motion that may be the turning's own error

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

void StandstillWatch::see(const ImageFeatures& features, const Eigen::Isometry3d& T_odom_cam) {
  const Eigen::Matrix3d R_odom_cam = T_odom_cam.linear();
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < features.size(); ++i) {
    rays.emplace_back(features.track_id[i], R_odom_cam * features.bearing_cam[i].cast<double>());
  }
  std::sort(rays.begin(), rays.end(), [](const Ray& a, const Ray& b) { return a.first < b.first; });
  const Eigen::Vector3d position_odom = T_odom_cam.translation();
  if (!has_reference_ || (position_odom - position_odom_).norm() > kRest_m) {
    reset();
    position_odom_ = position_odom;
    return begin(features.stamp_ns, R_odom_cam, std::move(rays));
  }
  const Motion motion = motionTo(rays, R_odom_cam);
  const bool is_moved = motion.unexplained_rad * features.focal_length_px > kMotion_px &&
                        motion.unexplained_rad > kExplained * motion.seen_rad;
  const std::int64_t passed_ns = features.stamp_ns - stamp_ns_;
  if (motion.tracks < kTracks) return begin(features.stamp_ns, R_odom_cam, std::move(rays));
  if (!is_moved && passed_ns < kWindow_ns) return;
  moving_ns_ = is_moved ? moving_ns_ + passed_ns : 0;
  is_stuck_ = is_stuck_ || moving_ns_ >= kPatience_ns;
  begin(features.stamp_ns, R_odom_cam, std::move(rays));
}

StandstillWatch::Motion StandstillWatch::motionTo(const std::vector<Ray>& rays,
                                                  const Eigen::Matrix3d& R_odom_cam) const {
  std::vector<double> seen_rad;
  std::vector<double> unexplained_rad;
  auto before = rays_.begin();
  for (const Ray& ray : rays) {
    while (before != rays_.end() && before->first < ray.first) ++before;
    if (before == rays_.end()) break;
    if (before->first != ray.first) continue;
    // Small angles: the chord.
    unexplained_rad.push_back((ray.second - before->second).norm());
    seen_rad.push_back(
        (R_odom_cam.transpose() * ray.second - R_odom_cam_.transpose() * before->second).norm());
  }
  if (seen_rad.empty()) return {};
  return {seen_rad.size(), median(seen_rad), median(unexplained_rad)};
}

void StandstillWatch::begin(std::int64_t stamp_ns, const Eigen::Matrix3d& R_odom_cam,
                            std::vector<Ray> rays) {
  has_reference_ = true;
  stamp_ns_ = stamp_ns;
  R_odom_cam_ = R_odom_cam;
  rays_ = std::move(rays);
}

std::string explainStandstill(const std::string& odometry_topic) {
  return "the odometry on " + odometry_topic +
         " does not move although the images do, so the pose cannot be right: check what publishes "
         "it (`rostopic echo " +
         odometry_topic + "/pose/pose`), or remap `odometry` to another topic";
}

}  // namespace ardrone_vslam
