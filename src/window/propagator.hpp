// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <optional>

#include "ardrone_vslam/msckf_config.hpp"
#include "ardrone_vslam/odometry_buffer.hpp"
#include "noise/learned_noise.hpp"
#include "odometry/odometry_step.hpp"
#include "window/window_state.hpp"

namespace ardrone_vslam {

/// Carries the window's state on by the odometry: the way since the newest frame, corrected by what
/// is known of the odometry's errors, and how these grow and fade.
class Propagator {
 public:
  /// @throws ConfigError listing every parameter out of its range
  explicit Propagator(const OdometryNoiseConfig& config, const FrameIds& ids = FrameIds(1));

  /// Map equals odom; the first frame is the window's only one.
  void start(const OdometryState& odometry, WindowState& state);
  /// Learns how large the bias of the odometry's velocity is, before the frame of this odometry is
  /// added. Not for a drone at rest: what odometry does there it need not do in flight.
  void learnVelocityBias(const OdometryState& odometry, const WindowState& state);
  /// Learns how fast the odometry's yaw drifts.
  void learnYaw(const SetupFinding& finding) { learned_.yaw.learn(finding); }
  /// Adds a frame by the odometry's increment since the newest one. O(coordinates).
  /// @param step  of that increment: counts as the newest position's uncertainty, not as a way
  void propagate(const OdometryState& odometry, const std::optional<OdometryStep>& step,
                 WindowState& state);
  /// Begins anew beside the anchors, with one frame where the odometry and this transform put it:
  /// what was learned of the odometry's velocity and attitude is forgotten. What the frame moves by
  /// counts as its sigma. There must be no other frame.
  void returnTo(const Eigen::Isometry3d& T_map_odom, WindowState& state);
  /// Its states from now on will be in another frame: the last one goes along.
  void moveOdometry(const Eigen::Isometry3d& T_new_odom) {
    odometry_.T_odom_base = T_new_odom * odometry_.T_odom_base;
    position_odom_m_ = T_new_odom * position_odom_m_;
  }
  /// Takes the odometry's velocity for so many times worse, in variance, as it was learned.
  void inflate(double factor, WindowState& state);

  /// Takes the odometry's newest pose to the newest frame's.
  Eigen::Isometry3d T_map_odom(const WindowState& state) const;
  /// What the odometry says of base since it began, jumps of its position left out.
  Eigen::Isometry3d T_odom_base() const;
  /// By the odometry, since it began.
  double travelled_m() const { return odometry_travelled_m_; }
  /// The odometry's velocity bias over what is configured.
  double biasSigmas(const WindowState& state) const;
  /// The odometry's noise that is in force.
  const LearnedNoise& learned() const { return learned_; }

 private:
  /// What the odometry reports between two frames.
  struct Increment {
    double duration_s = 0;
    Eigen::Vector3d displacement_odom_m = Eigen::Vector3d::Zero();
    double displacement_m = 0;  // length of the way
  };

  void addPosition(const OdometryState& odometry, const Increment& increment, Clone& next,
                   WindowState& state) const;
  void addAttitude(const OdometryState& odometry, Clone& next, WindowState& state) const;
  void propagateGlobals(const OdometryState& odometry, const Increment& increment,
                        WindowState& state);

  OdometryNoiseConfig config_;
  OdometryState odometry_;  // of the newest frame
  FrameIds ids_;
  double inflation_ = 1;
  double inflation_of_state_ = 1;  // follows it: at once when it rises, as the bias fades when not
  LearnedNoise learned_;
  double odometry_travelled_m_ = 0;                            // since it began
  Eigen::Vector3d position_odom_m_ = Eigen::Vector3d::Zero();  // jumps left out
};

}  // namespace ardrone_vslam
