// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "ardrone_vslam/parameters.hpp"

namespace ardrone_vslam {

/// How the odometry errs, as the MSCKF models it. The defaults suit a drone whose
/// velocity comes from optical flow.
struct OdometryNoiseConfig {
  double start_sigma_m = 0.001;
  double walk_m_per_sqrt_m = 0.012;
  double walk_m_per_sqrt_s = 0.02;
  double velocity_bias_m_s = 0.03;
  double velocity_bias_time_s = 20;
  double slow_speed_m_s = 0.1;
  double scale_sigma = 0.03;
  double tilt_sigma_deg = 0.5;
  double tilt_time_s = 30;
  double yaw_walk_deg_per_sqrt_s = 0.15;
  double yaw_walk_deg_per_sqrt_m = 0.03;
  double attitude_noise_deg = 0.15;
  double extrinsics_sigma_deg = 0;
};

template <class Visitor>
void visitParameters(OdometryNoiseConfig& c, Visitor&& visit) {
  visit(ParameterInfo{"start_sigma_m", "m", 1e-6, 100,
                      "MSCKF: position deviation at the first image"},
        c.start_sigma_m);
  visit(ParameterInfo{"walk_m_per_sqrt_m", "m/sqrt(m)", 0, 10,
                      "MSCKF: white odometry noise per square root of the way, where the "
                      "odometry gives no covariance"},
        c.walk_m_per_sqrt_m);
  visit(ParameterInfo{"walk_m_per_sqrt_s", "m/sqrt(s)", 0, 10,
                      "MSCKF: the same per square root of time"},
        c.walk_m_per_sqrt_s);
  visit(ParameterInfo{"velocity_bias_m_s", "m/s", 0, 10,
                      "MSCKF: slow error of the odometry's velocity, per axis"},
        c.velocity_bias_m_s);
  visit(ParameterInfo{"velocity_bias_time_s", "s", 0.1, 1e6, "MSCKF: time constant of that error"},
        c.velocity_bias_time_s);
  visit(ParameterInfo{"slow_speed_m_s", "m/s", 0.001, 100,
                      "MSCKF: above this speed an error along the way counts as one of "
                      "scale, which one camera cannot see"},
        c.slow_speed_m_s);
  visit(ParameterInfo{"scale_sigma", "-", 1e-6, 1, "MSCKF: constant scale error of the odometry"},
        c.scale_sigma);
  visit(ParameterInfo{"tilt_sigma_deg", "deg", 0, 45,
                      "MSCKF: slow error of the odometry's roll and pitch"},
        c.tilt_sigma_deg);
  visit(ParameterInfo{"tilt_time_s", "s", 0.1, 1e6, "MSCKF: time constant of that error"},
        c.tilt_time_s);
  visit(ParameterInfo{"yaw_walk_deg_per_sqrt_s", "deg/sqrt(s)", 0, 45,
                      "MSCKF: drift of the odometry's yaw with time"},
        c.yaw_walk_deg_per_sqrt_s);
  visit(ParameterInfo{"yaw_walk_deg_per_sqrt_m", "deg/sqrt(m)", 0, 45,
                      "MSCKF: the same with the way"},
        c.yaw_walk_deg_per_sqrt_m);
  visit(ParameterInfo{"attitude_noise_deg", "deg", 0.001, 45,
                      "MSCKF: white error of the odometry's attitude, per axis"},
        c.attitude_noise_deg);
  visit(ParameterInfo{"extrinsics_sigma_deg", "deg", 0, 45,
                      "MSCKF: constant error of the camera's attitude in base, per axis; "
                      "0: the mounting is exact"},
        c.extrinsics_sigma_deg);
}

/// How long odometry is kept, and across what holes it is interpolated.
struct OdometryBufferConfig {
  double buffer_s = 10.0;
  double max_gap_s = 0.5;
};

template <class Visitor>
void visitParameters(OdometryBufferConfig& c, Visitor&& visit) {
  visit(ParameterInfo{"odometry_buffer_s", "s", 0.1, 600.0,
                      "odometry kept for images that arrive late"},
        c.buffer_s);
  visit(ParameterInfo{"odometry_max_gap_s", "s", 0.001, 10.0,
                      "longest hole in the odometry that is interpolated across"},
        c.max_gap_s);
}

/// What of the odometry is believed.
enum class OdometryMode {
  kPose,    ///< the odometry's pose
  kTwist,   ///< its twist, integrated anew, and its orientation
  kNavdata  ///< the drone's own packets (DroneObserver)
};

template <>
struct EnumNames<OdometryMode> {
  static constexpr std::array<const char*, 3> kNames{"pose", "twist", "navdata"};
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
                    "pose: the odometry's position is believed; twist: it is integrated anew from "
                    "the twist (axes of base) and the orientation, for drivers that integrate "
                    "wrongly (ardrone_autonomy's yaw is mirrored); navdata: the package's own "
                    "observer of the AR.Drone's topics `navdata` and `imu` takes the odometry's "
                    "place. odometry_fusion needs the same"},
      c.mode);
  visit(
      ParameterInfo{"odometry_height", "choice", 0, 0,
                    "odometry_mode twist: z is the pose's, without steps that no climb explains (a "
                    "table below), or integrated like x and y"},
      c.height);
}

/// How the drone's sensors err and how it flies.
struct DroneFilterConfig {
  double flow_noise_m_s_per_sqrt_hz = 0.013;
  double flow_bias_m_s = 0.03;
  double flow_bias_time_s = 20;
  double flow_scale_sigma = 0.03;
  double tilt_sigma_deg = 0.3;
  double tilt_time_s = 30;
  double yaw_walk_deg_per_sqrt_s = 0.13;
  double force_noise_m_s2_per_sqrt_hz = 0.01;
  double force_bias_m_s2 = 0.05;
  double drag_per_s = 0.3;
  double drag_sigma_per_s = 0.1;
  double gust_m_s2_per_sqrt_hz = 0.03;
  double height_noise_m = 0.02;
  double table_step_m = 0.15;
  double command_tilt_deg = 12;
  double command_time_s = 0.12;
};

template <class Visitor>
void visitParameters(DroneFilterConfig& c, Visitor&& visit) {
  visit(ParameterInfo{"navdata_flow_noise_m_s_per_sqrt_hz", "m/s/sqrt(Hz)", 1e-4, 1,
                      "odometry_mode navdata: white noise of the optical flow's velocities"},
        c.flow_noise_m_s_per_sqrt_hz);
  visit(ParameterInfo{"navdata_flow_bias_m_s", "m/s", 0, 1, "their slow error, per axis"},
        c.flow_bias_m_s);
  visit(ParameterInfo{"navdata_flow_bias_time_s", "s", 0.1, 1e6, "time constant of that error"},
        c.flow_bias_time_s);
  visit(ParameterInfo{"navdata_flow_scale_sigma", "-", 0, 1, "their constant scale error"},
        c.flow_scale_sigma);
  visit(ParameterInfo{"navdata_tilt_sigma_deg", "deg", 0, 45,
                      "slow error of the reported roll and pitch"},
        c.tilt_sigma_deg);
  visit(ParameterInfo{"navdata_tilt_time_s", "s", 0.1, 1e6, "time constant of that error"},
        c.tilt_time_s);
  visit(ParameterInfo{"navdata_yaw_walk_deg_per_sqrt_s", "deg/sqrt(s)", 0, 45,
                      "drift of the reported yaw"},
        c.yaw_walk_deg_per_sqrt_s);
  visit(ParameterInfo{"navdata_force_noise_m_s2_per_sqrt_hz", "m/s^2/sqrt(Hz)", 1e-4, 10,
                      "white noise of the accelerometer"},
        c.force_noise_m_s2_per_sqrt_hz);
  visit(ParameterInfo{"navdata_force_bias_m_s2", "m/s^2", 0, 10, "its bias, per axis"},
        c.force_bias_m_s2);
  visit(ParameterInfo{"navdata_drag_per_s", "1/s", 0, 10,
                      "deceleration by the air, per speed; it is what the accelerometer feels "
                      "across the thrust"},
        c.drag_per_s);
  visit(ParameterInfo{"navdata_drag_sigma_per_s", "1/s", 0, 10, "how well that is known"},
        c.drag_sigma_per_s);
  visit(ParameterInfo{"navdata_gust_m_s2_per_sqrt_hz", "m/s^2/sqrt(Hz)", 1e-4, 10,
                      "accelerations that neither thrust nor drag explains"},
        c.gust_m_s2_per_sqrt_hz);
  visit(ParameterInfo{"navdata_height_noise_m", "m", 1e-4, 1,
                      "deviation of the height above the floor, of each of 25 echoes a second"},
        c.height_noise_m);
  visit(ParameterInfo{"navdata_table_step_m", "m", 0.01, 10,
                      "a height that differs by more from what accelerometer and velocity foresee "
                      "is another floor (a table), no climb"},
        c.table_step_m);
  visit(ParameterInfo{"navdata_command_tilt_deg", "deg", 0.1, 45,
                      "tilt at a cmd_vel of 1 (the drone's euler_angle_max): where navdata has a "
                      "hole, what it was told says how it flew"},
        c.command_tilt_deg);
  visit(ParameterInfo{"navdata_command_time_s", "s", 0.001, 10,
                      "time constant with which roll and pitch follow, twice over"},
        c.command_time_s);
}

/// Where heights above the floor come from.
struct HeightInputConfig {
  bool use_range = false;
  bool use_navdata_height = false;
  double range_max_gap_s = 0.1;
  double range_max_tilt_deg = 20;
  double known_height_m = 0;
};

template <class Visitor>
void visitParameters(HeightInputConfig& c, Visitor&& visit) {
  visit(ParameterInfo{"use_range", "switch", 0, 0,
                      "MSCKF: a range sensor that looks down (the topic `range`) tells "
                      "the height above the floor, and so the scale when it changes"},
        c.use_range);
  visit(ParameterInfo{"use_navdata_height", "switch", 0, 0,
                      "MSCKF: the height above the floor in the AR.Drone's navdata (the "
                      "topic `altitude`) takes the range's place"},
        c.use_navdata_height);
  visit(ParameterInfo{"range_max_gap_s", "s", 0.001, 10,
                      "ranges and navdata heights are interpolated at the image's stamp across no "
                      "longer a hole; at "
                      "their end the nearest one counts for as long"},
        c.range_max_gap_s);
  visit(ParameterInfo{"range_max_tilt_deg", "deg", 0, 80,
                      "ranges are not used while base is tilted by more"},
        c.range_max_tilt_deg);
  visit(ParameterInfo{"known_height_m", "m", 0, 1000,
                      "MSCKF: constant height of base above a level floor (a robot on "
                      "wheels); holds z, tells nothing of the scale; 0: not used"},
        c.known_height_m);
}

/// How long odometry is kept, and how the raw odometry errs between a correction's stamp and now;
/// names and defaults are those of the MSCKF.
struct DelayedFusionConfig {
  OdometryBufferConfig odometry;
  OdometryAdapterConfig odometry_adapter;  ///< of what is pushed: the mapper's
  double walk_m_per_sqrt_m = OdometryNoiseConfig{}.walk_m_per_sqrt_m;
  double walk_m_per_sqrt_s = OdometryNoiseConfig{}.walk_m_per_sqrt_s;
  double velocity_bias_m_s = OdometryNoiseConfig{}.velocity_bias_m_s;
  double scale_sigma = OdometryNoiseConfig{}.scale_sigma;
  double tilt_sigma_deg = OdometryNoiseConfig{}.tilt_sigma_deg;
  double tilt_time_s = OdometryNoiseConfig{}.tilt_time_s;
  double yaw_walk_deg_per_sqrt_s = OdometryNoiseConfig{}.yaw_walk_deg_per_sqrt_s;
  double yaw_walk_deg_per_sqrt_m = OdometryNoiseConfig{}.yaw_walk_deg_per_sqrt_m;
};

template <class Visitor>
void visitParameters(DelayedFusionConfig& c, Visitor&& visit) {
  visitParameters(c.odometry, visit);
  visitParameters(c.odometry_adapter, visit);
  visit(ParameterInfo{"walk_m_per_sqrt_m", "m/sqrt(m)", 0, 10,
                      "white odometry noise per square root of the way since the correction, where "
                      "the odometry gives no covariance"},
        c.walk_m_per_sqrt_m);
  visit(ParameterInfo{"walk_m_per_sqrt_s", "m/sqrt(s)", 0, 10, "the same per square root of time"},
        c.walk_m_per_sqrt_s);
  visit(ParameterInfo{"velocity_bias_m_s", "m/s", 0, 10,
                      "slow error of the odometry's velocity, per axis"},
        c.velocity_bias_m_s);
  visit(ParameterInfo{"scale_sigma", "-", 0, 1, "constant scale error of the odometry"},
        c.scale_sigma);
  visit(
      ParameterInfo{"tilt_sigma_deg", "deg", 0, 45, "slow error of the odometry's roll and pitch"},
      c.tilt_sigma_deg);
  visit(ParameterInfo{"tilt_time_s", "s", 0.1, 1e6, "time constant of that error"}, c.tilt_time_s);
  visit(ParameterInfo{"yaw_walk_deg_per_sqrt_s", "deg/sqrt(s)", 0, 45,
                      "drift of the odometry's yaw with time"},
        c.yaw_walk_deg_per_sqrt_s);
  visit(ParameterInfo{"yaw_walk_deg_per_sqrt_m", "deg/sqrt(m)", 0, 45, "the same with the way"},
        c.yaw_walk_deg_per_sqrt_m);
}

}  // namespace ardrone_vslam
