// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>

#include "ardrone_vslam/setup_watch.hpp"
#include "msckf/contrary_tracks.hpp"

namespace ardrone_vslam {

/// How long the pose is the odometry's when trust has ended for the first time: long enough to get
/// out of a mirror's or a crowd's view.
constexpr double kFirstPause_s = 10;

/// How far camera and odometry contradict each other at one image.
struct Contradiction {
  double bias_sigmas = 0;            ///< of the velocity bias that the camera has told the filter
  std::optional<double> fix_nis;     ///< when landmarks of an earlier visit were compared
  bool is_camera_confirmed = false;  ///< such landmarks were in agreement with the pose
  ComparedTracks tracks;
};

/// Ends the trust in the camera when it contradicts the odometry for longer than chance or a worse
/// odometry explains: a wrong calibration, a scene that moves, a mirror. Which of the two is wrong
/// nobody knows, but without the camera the pose is never worse than the odometry.
class Watchdog {
 public:
  /// While the set-up has a fault there is no trust, from the next see() on.
  void heed(const SetupFinding& finding) { setup_ = finding; }
  /// @return whether trust ends with this image
  bool see(std::int64_t stamp_ns, const Contradiction& contradiction);
  /// For kFirstPause_s after trust ended, and twice as long each time it ends again; and while the
  /// set-up has a fault.
  bool isDistrustful(std::int64_t stamp_ns) const;
  /// Nothing hints at a contradiction: camera and odometry are a good deal closer than the limits.
  bool isCalm() const { return calm_; }
  /// ContraryTracks::doubtfulWay_m()
  double doubtfulWay_m() const { return tracks_.doubtfulWay_m(); }

  /// Remembers this one while nothing hints at a contradiction.
  void keepWhileCalm(const Eigen::Isometry3d& T_map_odom) {
    if (isCalm()) calm_T_map_odom_ = T_map_odom;
    if (isCalm() && setup_.is_confirmed) confirmed_T_map_odom_ = T_map_odom;
  }
  /// The odometry's frame jumps: what is remembered goes along.
  void step(const Eigen::Vector3d& jump_odom_m) {
    for (Eigen::Isometry3d* T_map_odom : {&calm_T_map_odom_, &confirmed_T_map_odom_})
      T_map_odom->translation() -= T_map_odom->linear() * jump_odom_m;
  }
  /// Map and odometry's frame are moved alike: what is remembered goes along.
  void moveInto(const Eigen::Isometry3d& T_new_old) {
    for (Eigen::Isometry3d* T_map_odom : {&calm_T_map_odom_, &confirmed_T_map_odom_})
      *T_map_odom = T_new_old * *T_map_odom * T_new_old.inverse();
  }
  /// The last one remembered: to go back to when trust ends. With a fault of the set-up it is that
  /// of the last time at which the set-up was confirmed; before, map equals odom.
  const Eigen::Isometry3d& trustedT_map_odom() const {
    return setup_.fault == SetupFault::kNone ? calm_T_map_odom_ : confirmed_T_map_odom_;
  }
  bool doubtsAll() const { return setup_.forgets_images; }  ///< even that one

 private:
  std::optional<std::int64_t> last_ns_;
  double pause_s_ = kFirstPause_s;        // the next one
  std::optional<std::int64_t> until_ns_;  // the end of the pause
  double bias_s_ = 0;                     // how long each has been beyond its limit
  double fixes_s_ = 0;
  ContraryTracks tracks_;
  bool calm_ = true;
  SetupFinding setup_;
  bool is_refused_ = false;  // as of the last image
  Eigen::Isometry3d calm_T_map_odom_ = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d confirmed_T_map_odom_ = Eigen::Isometry3d::Identity();
};

}  // namespace ardrone_vslam
