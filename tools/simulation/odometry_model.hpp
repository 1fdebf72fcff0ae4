// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ardrone_vslam/odometry_buffer.hpp"
#include "trajectory/trajectory.hpp"

namespace ardrone_vslam {

/// How odometry drifts (noise in the body frame). OU(s, T): Ornstein-Uhlenbeck process of
/// sigma s, time constant T.
struct OdometryProfile {
  std::string name;
  double rate_hz = 50;
  double scale_sigma = 0;            ///< of the scale error, drawn once per run
  double step_noise = 0;             ///< white, share of each step's length
  double velocity_bias_m_s = 0;      ///< OU sigma per axis
  double velocity_bias_time_s = 20;  ///< OU time constant
  double velocity_noise_m_s = 0;     ///< white at 15 Hz, scaled by the root of the rate
  double yaw_scale_sigma = 0;  ///< of the error of turns, as a share of them, drawn once per run
  double yaw_walk_rad_per_sqrt_m = 0;
  double yaw_walk_rad_per_sqrt_s = 0;
  double attitude_bias_rad = 0;  ///< OU sigma of roll and pitch
  double attitude_bias_time_s = 30;
  double attitude_noise_rad = 0;  ///< white, roll, pitch, yaw
  double delay_s = 0;             ///< unknown to the user: stamps are late by this
  double loss = 0;                ///< share of the states lost
  bool bursts = false;            ///< bursts of states with equal stamps
  /// Profiles that take its place later, as to noise and biases; rate, scale errors and transport
  /// stay.
  std::vector<OdometryProfile> later;
  double from_s = 0;  ///< of a later one: after the truth's begin

  bool isTruth() const { return name == "truth"; }
};

/// Reads one profile from config/odometry_profiles.yaml (tools find it by findConfigFile()).
/// @param name  of a profile; or "A,B@S,..": A, from second S on B
/// @throws std::runtime_error naming the file, the fault and the known names
OdometryProfile loadOdometryProfile(const std::string& name, const std::string& profiles_yaml);

/// The names in the file, in its order. @throws std::runtime_error as above
std::vector<std::string> odometryProfileNames(const std::string& profiles_yaml);

struct OdometryRun {
  std::vector<OdometryState> states;
  double scale_error = 0;  ///< drawn; reported lengths are (1 + scale_error) times the true ones
  bool is_late = false;    ///< the profile has a delay: images and truth have another clock
};

/// Corrupts the true increments as `profile` says (config/odometry_profiles.yaml) and integrates
/// them with the corrupted attitude from the truth's first pose. States come every 1 / rate_hz from
/// the truth's first stamp to the first one at or after its last, so that every image can be
/// interpolated (where the profile has a delay the drone is taken to have stood that long before).
/// `truth` gives the interpolated truth itself. Covariances are zero, as ardrone_autonomy's: none
/// given. Bursts repeat stamps; without them stamps ascend strictly. Equal arguments give equal
/// results on every machine with the same floating point. @pre truth not empty
OdometryRun simulateOdometry(const Trajectory& truth, const OdometryProfile& profile,
                             std::uint64_t seed);

}  // namespace ardrone_vslam
