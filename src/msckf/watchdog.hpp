// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>

namespace ardrone_vslam {

/// How long the pose is the odometry's when trust has ended for the first time: long enough to get
/// out of a mirror's or a crowd's view.
constexpr double kFirstPause_s = 10;

/// How far camera and odometry contradict each other at one image.
struct Contradiction {
  double bias_sigmas = 0;            ///< of the velocity bias that the camera has told the filter
  std::optional<double> fix_nis;     ///< when landmarks of an earlier visit were compared
  bool is_camera_confirmed = false;  ///< such landmarks were in agreement with the pose
};

/// Ends the trust in the camera when it contradicts the odometry for longer than chance or a worse
/// odometry explains: a wrong calibration, a scene that moves, a mirror. Which of the two is wrong
/// nobody knows, but without the camera the pose is never worse than the odometry.
class Watchdog {
 public:
  /// @return whether trust ends with this image
  bool see(std::int64_t stamp_ns, const Contradiction& contradiction);
  /// For kFirstPause_s after trust ended, and twice as long each time it ends again.
  bool isDistrustful(std::int64_t stamp_ns) const;
  /// Nothing hints at a contradiction: camera and odometry are a good deal closer than the limits.
  bool isCalm() const { return calm_; }

  /// Remembers this one while nothing hints at a contradiction.
  void keepWhileCalm(const Eigen::Isometry3d& T_map_odom) {
    if (isCalm()) calm_T_map_odom_ = T_map_odom;
  }
  /// The odometry's frame jumps: what is remembered goes along.
  void step(const Eigen::Vector3d& jump_odom_m) {
    calm_T_map_odom_.translation() -= calm_T_map_odom_.linear() * jump_odom_m;
  }
  /// The last one remembered: to go back to when trust ends.
  const Eigen::Isometry3d& calmT_map_odom() const { return calm_T_map_odom_; }

 private:
  std::optional<std::int64_t> last_ns_;
  double pause_s_ = kFirstPause_s;        // the next one
  std::optional<std::int64_t> until_ns_;  // the end of the pause
  double bias_s_ = 0;                     // how long each has been beyond its limit
  double fixes_s_ = 0;
  bool calm_ = true;
  Eigen::Isometry3d calm_T_map_odom_ = Eigen::Isometry3d::Identity();
};

}  // namespace ardrone_vslam
