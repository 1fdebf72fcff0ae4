// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "ardrone/drone_model.hpp"
#include "ardrone_vslam/odometry_buffer.hpp"

namespace ardrone_vslam {

/// A height that differs by more from what accelerometer and velocity foresee is another floor (a
/// table), no climb.
constexpr double kTableStep_m = 0.15;

/// How the drone's sensors err and how it flies, as measured in recordings. No parameters: another
/// AR.Drone errs alike, and the filter weighs what it finds.
struct DroneErrors {
  double flow_noise_m_s_per_sqrt_hz = 0.013;   ///< white, of the optical flow's velocities
  double flow_bias_m_s = 0.03;                 ///< their slow error, per axis
  double flow_bias_time_s = 20;                ///< its time constant
  double flow_scale_sigma = 0.03;              ///< their constant scale error
  double tilt_sigma_deg = 0.3;                 ///< slow error of the reported roll and pitch
  double tilt_time_s = 30;                     ///< its time constant
  double yaw_walk_deg_per_sqrt_s = 0.13;       ///< drift of the reported yaw
  double force_noise_m_s2_per_sqrt_hz = 0.01;  ///< white, of the accelerometer
  double force_bias_m_s2 = 0.05;               ///< its bias, per axis
  double drag_per_s = 0.3;  ///< deceleration by the air, per speed: what is felt across the thrust
  double drag_sigma_per_s = 0.1;        ///< how well that is known
  double gust_m_s2_per_sqrt_hz = 0.03;  ///< accelerations that neither thrust nor drag explains
  double height_noise_m = 0.02;         ///< of the height, of each of the sonar's echoes
};

/// Extended Kalman filter of the drone's motion, by drone_model.
class DroneFilter {
 public:
  /// Where attitude and force of a time come from: of a hole they are guessed.
  enum class Known {
    kMeasured,     ///< a packet's
    kCommanded,    ///< what cmd_vel told the drone to do
    kInterpolated  ///< between the packets around the hole
  };
  using State = drone_model::State;            ///< means
  using Covariance = drone_model::Covariance;  ///< of their errors

  explicit DroneFilter(const DroneErrors& errors = {}) : errors_(errors) {}

  /// At x = y = 0, its height that above the floor.
  void begin(const DroneMeasurement& measured);
  /// Flies on for so long.
  void predict(const DroneMeasurement& measured, double dt_s, Known known = Known::kMeasured);
  /// Stands still for so long.
  void rest(double dt_s);
  /// @param dt_s  since the measurement before: that of the sensors' noise
  void updateVelocity(const DroneMeasurement& measured, double dt_s);
  /// @param height_m  above what is below, measured
  /// @param dt_s  since the height before: neighbours err alike
  void updateHeight(double height_m, double dt_s);

  /// Height measured less height foreseen, and the sigma of that.
  double heightInnovation_m(double height_m) const;
  /// Standard deviation of heightInnovation_m().
  double heightSigma_m() const;
  /// The floor is now `floor_m` high, by the position: another one than before, unless it is that
  /// of the beginning again.
  void changeFloor(double floor_m);
  /// Position and velocity have become unknown by so much.
  void widen(double position_m, double velocity_m_s);

  /// Means after the last call.
  const State& state() const { return x_; }
  /// Covariance after the last call.
  const Covariance& covariance() const { return P_; }
  /// Pose with covariance, velocity with covariance; no stamp, no turn rate.
  OdometryState observed(const Eigen::Matrix3d& R_reported) const;

 private:
  void addNoise(double dt_s, double acceleration_noise);
  void update(double innovation, const Eigen::Matrix<double, 1, drone_model::kSize>& H,
              double variance);

  DroneErrors errors_;
  State x_ = State::Zero();
  Covariance P_ = Covariance::Zero();
};

}  // namespace ardrone_vslam
