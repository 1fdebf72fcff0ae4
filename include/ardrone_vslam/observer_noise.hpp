// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ardrone_vslam/parameters.hpp"

namespace ardrone_vslam {

/// How the odometry errs, as the constraint filter models it. The defaults suit a drone whose
/// velocity comes from optical flow.
struct ObserverNoiseConfig {
  double start_deviation_m = 0.001;
  double walk_m_per_sqrt_m = 0.012;
  double walk_m_per_sqrt_s = 0.02;
  double velocity_bias_m_s = 0.03;
  double velocity_bias_time_s = 20;
  double slow_speed_m_s = 0.1;
  double scale_deviation = 0.03;
  double tilt_deviation_deg = 0.5;
  double tilt_time_s = 30;
  double yaw_walk_deg_per_sqrt_s = 0.15;
  double yaw_walk_deg_per_sqrt_m = 0.03;
  double attitude_noise_deg = 0.15;
  double mounting_deviation_deg = 0;
};

template <class Visitor>
void visitParameters(ObserverNoiseConfig& c, Visitor&& visit) {
  visit(ParameterInfo{"start_deviation_m", "m", 1e-6, 100,
                      "constraint filter: position deviation at the first image"},
        c.start_deviation_m);
  visit(
      ParameterInfo{"walk_m_per_sqrt_m", "m/sqrt(m)", 0, 10,
                    "constraint filter: white odometry noise per square root of the way, where the "
                    "observer gives no covariance"},
      c.walk_m_per_sqrt_m);
  visit(ParameterInfo{"walk_m_per_sqrt_s", "m/sqrt(s)", 0, 10,
                      "constraint filter: the same per square root of time"},
        c.walk_m_per_sqrt_s);
  visit(ParameterInfo{"velocity_bias_m_s", "m/s", 0, 10,
                      "constraint filter: slow error of the odometry's velocity, per axis"},
        c.velocity_bias_m_s);
  visit(ParameterInfo{"velocity_bias_time_s", "s", 0.1, 1e6,
                      "constraint filter: time constant of that error"},
        c.velocity_bias_time_s);
  visit(ParameterInfo{"slow_speed_m_s", "m/s", 0.001, 100,
                      "constraint filter: above this speed an error along the way counts as one of "
                      "scale, which one camera cannot see"},
        c.slow_speed_m_s);
  visit(ParameterInfo{"scale_deviation", "-", 1e-6, 1,
                      "constraint filter: constant scale error of the odometry"},
        c.scale_deviation);
  visit(ParameterInfo{"tilt_deviation_deg", "deg", 0, 45,
                      "constraint filter: slow error of the odometry's roll and pitch"},
        c.tilt_deviation_deg);
  visit(
      ParameterInfo{"tilt_time_s", "s", 0.1, 1e6, "constraint filter: time constant of that error"},
      c.tilt_time_s);
  visit(ParameterInfo{"yaw_walk_deg_per_sqrt_s", "deg/sqrt(s)", 0, 45,
                      "constraint filter: drift of the odometry's yaw with time"},
        c.yaw_walk_deg_per_sqrt_s);
  visit(ParameterInfo{"yaw_walk_deg_per_sqrt_m", "deg/sqrt(m)", 0, 45,
                      "constraint filter: the same with the way"},
        c.yaw_walk_deg_per_sqrt_m);
  visit(ParameterInfo{"attitude_noise_deg", "deg", 0.001, 45,
                      "constraint filter: white error of the odometry's attitude, per axis"},
        c.attitude_noise_deg);
  visit(
      ParameterInfo{"mounting_deviation_deg", "deg", 0, 45,
                    "constraint filter: constant error of the camera's attitude in base, per axis; "
                    "0: the mounting is exact"},
      c.mounting_deviation_deg);
}

}  // namespace ardrone_vslam
