// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "ardrone_vslam/parameters.hpp"

namespace ardrone_vslam {

/// How the odometry drifts. The defaults suit a drone whose velocity comes from optical flow.
struct OdometryDriftConfig {
  double velocity_bias_m_s = 0.03;
  double walk_m_per_sqrt_s = 0.02;
  double walk_m_per_sqrt_m = 0.012;
  double scale_sigma = 0.03;
  double tilt_sigma_deg = 0.5;
  double yaw_walk_deg_per_sqrt_s = 0.15;
  double yaw_walk_deg_per_sqrt_m = 0.03;

  // No parameters, but varied by tests: results hardly depend on how fast the slow errors change.
  double velocity_bias_time_s = 20;  ///< time constant of the velocity's error
  double tilt_time_s = 30;           ///< time constant of the error of roll and pitch
};

template <class Visitor>
void visitParameters(OdometryDriftConfig& c, Visitor&& visit) {
  visit(ParameterInfo{"velocity_bias_m_s", "m/s", 0, 10,
                      "slow error of the odometry's velocity, per axis; msckf begins with it and "
                      "learns it in flight",
                      turnFirst(8)},
        c.velocity_bias_m_s);
  visit(ParameterInfo{"walk_m_per_sqrt_s", "m/sqrt(s)", 0, 10,
                      "white noise of the odometry's position per square root of time, where the "
                      "odometry gives no covariance",
                      turnFirst(9)},
        c.walk_m_per_sqrt_s);
  visit(ParameterInfo{"walk_m_per_sqrt_m", "m/sqrt(m)", 0, 10,
                      "white noise of the odometry's position per square root of distance, where "
                      "the odometry gives no covariance",
                      turnFirst(10)},
        c.walk_m_per_sqrt_m);
  visit(ParameterInfo{"scale_sigma", "-", 1e-6, 1, "constant scale error of the odometry",
                      turnFirst(11)},
        c.scale_sigma);
  visit(ParameterInfo{"tilt_sigma_deg", "deg", 0, 45, "slow error of the odometry's roll and pitch",
                      turnFirst(12)},
        c.tilt_sigma_deg);
  visit(ParameterInfo{"yaw_walk_deg_per_sqrt_s", "deg/sqrt(s)", 0, 45,
                      "drift of the odometry's yaw with time", turnFirst(13)},
        c.yaw_walk_deg_per_sqrt_s);
  visit(ParameterInfo{"yaw_walk_deg_per_sqrt_m", "deg/sqrt(m)", 0, 45,
                      "drift of the odometry's yaw with distance", turnFirst(14)},
        c.yaw_walk_deg_per_sqrt_m);
}

/// How the odometry errs, as the MSCKF models it.
struct OdometryNoiseConfig : OdometryDriftConfig {
  double attitude_noise_deg = 0.15;
  double extrinsics_sigma_deg = 0;
};

template <class Visitor>
void visitParameters(OdometryNoiseConfig& c, Visitor&& visit) {
  visitParameters(static_cast<OdometryDriftConfig&>(c), visit);
  visit(ParameterInfo{"attitude_noise_deg", "deg", 0.001, 45,
                      "white noise of the odometry's attitude, per axis", turnFirst(15)},
        c.attitude_noise_deg);
  visit(ParameterInfo{"extrinsics_sigma_deg", "deg", 0, 45,
                      "constant error of the camera's attitude in base, per axis; 0: it is exact"},
        c.extrinsics_sigma_deg);
}

/// How long odometry is kept, and across what holes it is interpolated.
struct OdometryBufferConfig {
  double buffer_s = 10.0;
  /// Longest hole that is interpolated across. No parameter: odometry with longer ones is broken.
  double max_gap_s = 0.5;
};

template <class Visitor>
void visitParameters(OdometryBufferConfig& c, Visitor&& visit) {
  visit(ParameterInfo{"odometry_buffer_s", "s", 0.1, 600.0,
                      "how long odometry is kept for images that arrive late"},
        c.buffer_s);
}

/// What of the odometry is believed.
enum class OdometryMode {
  kPose,     ///< the odometry's pose
  kTwist,    ///< its twist, integrated anew, and its orientation
  kNavdata,  ///< the drone's own packets (DroneObserver)
  kImu       ///< its displacements, along an IMU's attitude (ImuOdometry)
};

template <>
struct EnumNames<OdometryMode> {
  static constexpr std::array<const char*, 4> kNames{"pose", "twist", "navdata", "imu"};
};

/// Where z comes from with OdometryMode::kTwist.
enum class OdometryHeight {
  kPose,  ///< the pose's, without the steps of furniture below
  kTwist  ///< integrated as x and y are
};

template <>
struct EnumNames<OdometryHeight> {
  static constexpr std::array<const char*, 2> kNames{"pose", "twist"};
};

/// Which part of the odometry's messages is believed.
struct OdometryAdapterConfig {
  OdometryMode mode = OdometryMode::kPose;
  OdometryHeight height = OdometryHeight::kPose;
};

template <class Visitor>
void visitParameters(OdometryAdapterConfig& c, Visitor&& visit) {
  visit(
      ParameterInfo{"odometry_mode", "choice", 0, 0,
                    "pose: the odometry's position is believed. With twist it is integrated anew "
                    "from the twist (axes of base) and the orientation, for drivers that integrate "
                    "wrongly (ardrone_autonomy's yaw is mirrored). With navdata the package's own "
                    "observer of the AR.Drone's topics `navdata` and `imu` takes the odometry's "
                    "place. With imu the attitude is that of the topic `imu`, and the odometry's "
                    "displacements are laid along it. `mapper` and `odometry_fusion` need the same",
                    turnFirst(3)},
      c.mode);
  visit(ParameterInfo{"odometry_height", "choice", 0, 0,
                      "with `odometry_mode: twist`. pose: z is the pose's, without steps that no "
                      "climb explains (a table below). twist: z is integrated like x and y"},
        c.height);
}

/// Where heights above the floor come from.
struct HeightInputConfig {
  bool use_range = false;
  bool use_navdata_height = false;
  double known_height_m = 0;
};

template <class Visitor>
void visitParameters(HeightInputConfig& c, Visitor&& visit) {
  visit(ParameterInfo{"use_range", "switch", 0, 0,
                      "a range sensor that looks down (the topic `range`) tells the height above "
                      "the floor, and so the scale when it changes",
                      turnFirst(4)},
        c.use_range);
  visit(ParameterInfo{"use_navdata_height", "switch", 0, 0,
                      "the AR.Drone's navdata (the topic `altitude`) tell the height above the "
                      "floor, and so the scale when it changes",
                      turnFirst(5)},
        c.use_navdata_height);
  visit(ParameterInfo{"known_height_m", "m", 0, 1000,
                      "constant height of base above a level floor, for `floor_points`: as "
                      "`planar`, it holds z and tells nothing of the scale; 0: not known"},
        c.known_height_m);
}

/// How long odometry is kept, and how the raw odometry errs between a correction's stamp and now.
struct DelayedFusionConfig : OdometryDriftConfig {
  OdometryBufferConfig odometry;
  OdometryAdapterConfig odometry_adapter;  ///< of what is pushed: the mapper's
};

template <class Visitor>
void visitParameters(DelayedFusionConfig& c, Visitor&& visit) {
  visitParameters(c.odometry, visit);
  visitParameters(c.odometry_adapter, visit);
  visitParameters(static_cast<OdometryDriftConfig&>(c), visit);
}

}  // namespace ardrone_vslam
