// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <string>
#include <vector>

#include "ardrone_vslam/drone_observer.hpp"
#include "driver/drone_dynamics.hpp"
#include "driver/drone_flight.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::int64_t kFirstPacket_ns = 1'400'000'000'000'000'000;

/// A drone that obeys, told to and fro, and is not heard of for 0.8 s. @return how far off the
/// observer is 0.1 s later [m]
double errorBeyondHole_m(int hole_at, bool is_told) {
  DroneDynamics drone;
  drone.takeOff();
  drone.advance(6, {});
  const Eigen::Vector3d begin_m = drone.state().T_world_body.translation();
  DroneObserver observer;
  std::vector<OdometryState> states;
  NavdataReading reading;
  reading.stamp_ns = kFirstPacket_ns;
  Eigen::Vector3d displacement_m = Eigen::Vector3d::Zero();
  for (int i = 0; i < hole_at + 180; ++i, reading.stamp_ns += 5'000'000) {
    DroneCommand command;
    command.forward = (i / 100) % 2 == 0 ? 0.8 : -0.8;
    command.left = (i / 60) % 2 == 0 ? 0.5 : -0.5;
    if (is_told)
      observer.push(DroneCommandReading{reading.stamp_ns, {command.forward, command.left}});
    const FlightState& state = drone.state();
    reading.measured.R_odom_base = state.T_world_body.linear();
    reading.measured.flow_base_m_s =
        (reading.measured.R_odom_base.transpose() * state.velocity_world_m_s).head<2>();
    reading.measured.force_base_m_s2 = state.specificForce_body_m_s2();
    reading.measured.height_m = state.T_world_body.translation().z();
    if (i < hole_at || i >= hole_at + 160) observer.push(reading, states);
    displacement_m = state.T_world_body.translation() - begin_m;
    drone.advance(1 / kPacketRate_hz, command);
  }
  observer.flush(states);
  const Eigen::Vector2d error_m =
      (states.back().T_odom_base.translation() - displacement_m).head<2>();
  const Eigen::Matrix2d P = states.back().covariance.topLeftCorner<2, 2>();
  EXPECT_LT(error_m.dot(P.ldlt().solve(error_m)), 16) << hole_at << ' ' << is_told;
  return error_m.norm();
}

TEST(DroneObserverCommands, TellTheWayAcrossAHole) {
  double told_m = 0;
  double untold_m = 0;
  for (int hole_at = 500; hole_at < 900; hole_at += 40) {
    told_m += errorBeyondHole_m(hole_at, true) / 10;
    untold_m += errorBeyondHole_m(hole_at, false) / 10;
  }
  RecordProperty("told_m", std::to_string(told_m));
  RecordProperty("untold_m", std::to_string(untold_m));
  EXPECT_LT(told_m, 0.5 * untold_m);
}

}  // namespace
}  // namespace ardrone_vslam
