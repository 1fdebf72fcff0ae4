// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "ardrone_vslam/observer_buffer.hpp"
#include "ardrone_vslam/parameters.hpp"

namespace ardrone_vslam {

/// How the drone's sensors err and how it flies.
struct DroneFilterConfig {
  double flow_noise_m_s_per_sqrt_hz = 0.013;
  double flow_bias_m_s = 0.03;
  double flow_bias_time_s = 20;
  double flow_scale_deviation = 0.03;
  double tilt_deviation_deg = 0.3;
  double tilt_time_s = 30;
  double yaw_walk_deg_per_sqrt_s = 0.13;
  double force_noise_m_s2_per_sqrt_hz = 0.01;
  double force_bias_m_s2 = 0.05;
  double drag_per_s = 0.3;
  double drag_deviation_per_s = 0.1;
  double gust_m_s2_per_sqrt_hz = 0.03;
  double height_noise_m = 0.02;
  double table_step_m = 0.15;
  double command_tilt_deg = 12;
  double command_time_s = 0.12;
};

template <class Visitor>
void visitParameters(DroneFilterConfig& c, Visitor&& visit) {
  visit(ParameterInfo{"navdata_flow_noise_m_s_per_sqrt_hz", "m/s/sqrt(Hz)", 1e-4, 1,
                      "observer_mode navdata: white noise of the optical flow's velocities"},
        c.flow_noise_m_s_per_sqrt_hz);
  visit(ParameterInfo{"navdata_flow_bias_m_s", "m/s", 0, 1, "their slow error, per axis"},
        c.flow_bias_m_s);
  visit(ParameterInfo{"navdata_flow_bias_time_s", "s", 0.1, 1e6, "time constant of that error"},
        c.flow_bias_time_s);
  visit(ParameterInfo{"navdata_flow_scale_deviation", "-", 0, 1, "their constant scale error"},
        c.flow_scale_deviation);
  visit(ParameterInfo{"navdata_tilt_deviation_deg", "deg", 0, 45,
                      "slow error of the reported roll and pitch"},
        c.tilt_deviation_deg);
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
  visit(ParameterInfo{"navdata_drag_deviation_per_s", "1/s", 0, 10, "how well that is known"},
        c.drag_deviation_per_s);
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

/// What the drone measures at one time.
struct DroneMeasurement {
  Eigen::Matrix3d R_odom_base = Eigen::Matrix3d::Identity();  ///< as reported
  Eigen::Vector2d flow_base_m_s = Eigen::Vector2d::Zero();    ///< forward, left
  Eigen::Vector3d force_base_m_s2 = Eigen::Vector3d::Zero();  ///< specific force
  double height_m = 0;  ///< above what is below; at most 0: not measured
};

/// Extended Kalman filter of the drone's motion. Thrust is along base's z, so its tilt tells the
/// acceleration, and what the accelerometer feels across it is the air's drag, which tells the
/// velocity: Martin and Salaun, The true role of accelerometer feedback in quadrotor control, 2010.
/// odom has z up; its x axis is that of the reported yaw's zero.
class DroneFilter {
 public:
  /// Where in the state: position [m] and velocity [m/s] of base, the latter turned by the yaw's
  /// error; what is to be put right of the reported tilt (rotation vector, axes of base) [rad];
  /// errors of the flow, of the accelerometer; drag [1/s]; height of the floor below [m]; the
  /// reported yaw's error [rad], always estimated as zero.
  enum Index {
    kPosition = 0,
    kVelocity = 3,
    kTilt = 6,
    kFlowBias = 8,
    kFlowScale = 10,
    kForceBias = 11,
    kDrag = 14,
    kFloor = 15,
    kYaw = 16,
    kSize = 17
  };
  /// Where attitude and force of a time come from: of a hole they are guessed.
  enum class Known {
    kMeasured,     ///< a packet's
    kCommanded,    ///< what cmd_vel told the drone to do
    kInterpolated  ///< between the packets around the hole
  };
  /// Means, placed by Index.
  using State = Eigen::Matrix<double, kSize, 1>;
  /// Of the State's errors, placed by Index.
  using Covariance = Eigen::Matrix<double, kSize, kSize>;
  /// Derivative of two quantities by the State.
  using Rows2 = Eigen::Matrix<double, 2, kSize>;

  /// What a measurement should be, and its derivative by the state.
  struct Foreseen {
    Eigen::Vector2d value =
        Eigen::Vector2d::Zero();     ///< forward and left, in the measurement's unit
    Rows2 jacobian = Rows2::Zero();  ///< of value by the State
  };

  /// @throws ConfigError listing every parameter out of its range
  explicit DroneFilter(const DroneFilterConfig& config);

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

  /// Height measured less height foreseen, and the deviation of that.
  double heightInnovation_m(double height_m) const;
  /// Standard deviation of heightInnovation_m().
  double heightDeviation_m() const;
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
  ObserverState observed(const Eigen::Matrix3d& R_reported) const;

  /// The equations, for predict and update: the state after dt_s and its derivative by the state.
  static State motion(const State& x, const DroneMeasurement& measured, double dt_s);
  /// Derivative of motion() by x.
  static Covariance motionJacobian(const State& x, const DroneMeasurement& measured, double dt_s);
  /// What the optical flow should report: base's velocity, forward and left [m/s].
  static Foreseen flow(const State& x, const Eigen::Matrix3d& R_reported);
  /// What the accelerometer should feel across the thrust, forward and left [m/s^2].
  static Foreseen drag(const State& x, const Eigen::Matrix3d& R_reported);

 private:
  void addNoise(double dt_s, double acceleration_noise);
  void update(double innovation, const Eigen::Matrix<double, 1, kSize>& H, double variance);

  DroneFilterConfig config_;
  State x_ = State::Zero();
  Covariance P_ = Covariance::Zero();
};

}  // namespace ardrone_vslam
