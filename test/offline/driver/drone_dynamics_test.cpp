// SPDX-License-Identifier: BSD-3-Clause
#include "driver/drone_dynamics.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/yaw.hpp"

namespace ardrone_vslam {
namespace {

using Phase = DroneDynamics::Phase;

DroneDynamics hovering(const FlightStart& start = {}) {
  DroneDynamics drone(start);
  drone.takeOff();
  drone.advance(6, {});
  return drone;
}

double tiltOf(const DroneDynamics& drone) {
  return std::acos(std::min(1.0, drone.state().T_world_body.linear()(2, 2)));
}

TEST(DroneDynamics, StandsUntilItTakesOffAndThenHovers) {
  DroneDynamics drone({1, 2, 0.5});
  drone.advance(2, {1, 1, 1, 1});
  EXPECT_EQ(drone.phase(), Phase::kLanded);
  EXPECT_TRUE(drone.state().T_world_body.translation().isApprox(Eigen::Vector3d(1, 2, 0)));
  EXPECT_TRUE(drone.state().specificForce_body_m_s2().isApprox(Eigen::Vector3d(0, 0, 9.81)));
  drone.takeOff();
  drone.advance(0.5, {1, 0, 0, 0});
  EXPECT_EQ(drone.phase(), Phase::kTakingOff);
  drone.advance(5.5, {});
  EXPECT_EQ(drone.phase(), Phase::kFlying);
  EXPECT_LT((drone.state().T_world_body.translation() - Eigen::Vector3d(1, 2, 1)).norm(), 0.1);
  EXPECT_LT(drone.state().velocity_world_m_s.norm(), 0.01);
  EXPECT_NEAR(test::yawOf(drone.state().T_world_body), 0.5, 1e-9);
}

TEST(DroneDynamics, FliesWhereItIsToldAndBrakesByItself) {
  DroneDynamics drone = hovering({0, 0, M_PI / 2});
  const double height_m = drone.state().T_world_body.translation().z();
  drone.advance(0.5, {0.5, 0, 0, 0});
  EXPECT_NEAR(tiltOf(drone), 0.106, 0.01);
  drone.advance(1.5, {0.5, 0, 0, 0});
  const Eigen::Vector3d velocity = drone.state().velocity_world_m_s;
  EXPECT_GT(velocity.y(), 1) << "the nose points along y";
  EXPECT_NEAR(velocity.x(), 0, 1e-6);
  EXPECT_NEAR(drone.state().T_world_body.translation().z(), height_m, 1e-3);
  drone.advance(6, {});
  EXPECT_LT(drone.state().velocity_world_m_s.norm(), 0.05);
  EXPECT_LT(tiltOf(drone), 0.01);
  drone.advance(2, {0, 0.5, 0, 0});
  EXPECT_LT(drone.state().velocity_world_m_s.x(), -1) << "left of y is -x";
}

TEST(DroneDynamics, ClimbsAndTurnsAtItsLimitsAndNoFaster) {
  DroneDynamics drone = hovering();
  drone.advance(3, {0, 0, 5, 0});
  EXPECT_NEAR(drone.state().velocity_world_m_s.z(), 0.7, 0.01);
  drone.advance(3, {0, 0, 0, -7});
  EXPECT_NEAR(drone.state().angular_rate_body_rad_s.z(), -1.75, 0.01);
  drone.advance(5, {9, 0, 0, 0});
  EXPECT_NEAR(tiltOf(drone), 0.21, 0.01);
}

TEST(DroneDynamics, LandsAndCanTakeOffAgain) {
  DroneDynamics drone = hovering();
  drone.land();
  drone.advance(0.2, {0, 0, 1, 0});
  EXPECT_EQ(drone.phase(), Phase::kLanding);
  drone.advance(5, {});
  EXPECT_EQ(drone.phase(), Phase::kLanded);
  EXPECT_EQ(drone.state().T_world_body.translation().z(), 0);
  EXPECT_EQ(drone.state().velocity_world_m_s.norm(), 0);
  drone.takeOff();
  drone.advance(6, {});
  EXPECT_EQ(drone.phase(), Phase::kFlying);
}

TEST(DroneDynamics, WithoutAutoHoverItLevelsOutButDoesNotBrake) {
  DroneDynamics braking = hovering(), gliding = hovering();
  for (DroneDynamics* drone : {&braking, &gliding}) drone->advance(1.5, {0.5, 0, 0, 0});
  braking.advance(3, {});
  gliding.advance(3, {0, 0, 0, 0, false});
  EXPECT_LT(braking.state().velocity_world_m_s.norm(), 0.1);
  EXPECT_GT(gliding.state().velocity_world_m_s.norm(), 0.3);
  EXPECT_LT(tiltOf(gliding), 0.01);
}

TEST(DroneDynamics, WindMovesIt) {
  DroneDynamics drone = hovering();
  drone.setWind({0.2, 0, 0});
  drone.advance(20, {});
  // Drag 0.3 per second against the wind balances drag and braking, 1.5 together, of its own speed.
  EXPECT_NEAR(drone.state().velocity_world_m_s.x(), 0.04, 0.005);
}

TEST(DroneDynamics, WallsStopIt) {
  DroneDynamics drone = hovering();
  const Eigen::AlignedBox3d space(Eigen::Vector3d(-1, -2, 0), Eigen::Vector3d(1.5, 2, 2.5));
  drone.keepWithin(space);
  drone.advance(5, {1, 0, 1, 0});
  EXPECT_EQ(drone.state().T_world_body.translation().x(), 1.5);
  EXPECT_EQ(drone.state().T_world_body.translation().z(), 2.5);
  EXPECT_LE(drone.state().velocity_world_m_s.x(), 0);
  drone.advance(5, {-1, 0, 0, 0});
  EXPECT_EQ(drone.state().T_world_body.translation().x(), -1);
  EXPECT_EQ(drone.phase(), Phase::kFlying);
  EXPECT_NEAR(drone.state().T_world_body.translation().z(), 2.5, 0.01);
}

TEST(DroneDynamics, FallsWhenItsMotorsAreCut) {
  DroneLimits limits;
  limits.stands_m = 0.1;
  DroneDynamics drone({}, limits);
  EXPECT_EQ(drone.state().T_world_body.translation().z(), 0.1);
  drone.cutMotors();
  EXPECT_EQ(drone.phase(), Phase::kLanded);
  drone.takeOff();
  drone.advance(6, {});
  drone.cutMotors();
  drone.advance(0.3, {0, 0, 1, 0});
  EXPECT_EQ(drone.phase(), Phase::kFalling);
  EXPECT_LT(drone.state().specificForce_body_m_s2().norm(), 1);
  drone.advance(0.5, {});
  EXPECT_EQ(drone.phase(), Phase::kLanded);
  EXPECT_EQ(drone.state().T_world_body.translation().z(), 0.1);
}

/// State against its own derivatives, and the lean against the acceleration, under wild commands.
TEST(DroneDynamics, ItsStateKeepsTheLawsOfMotion) {
  constexpr double kStep_s = 0.002;
  DroneDynamics drone = hovering();
  for (int i = 0; i < 4000; ++i) {
    const double t = i * kStep_s;
    const FlightState before = drone.state();
    drone.advance(kStep_s,
                  {std::sin(3 * t), std::cos(2 * t), 0.5 * std::sin(t), std::sin(1.3 * t)});
    const FlightState& now = drone.state();
    const Eigen::Vector3d displacement_m =
        now.T_world_body.translation() - before.T_world_body.translation();
    const Eigen::Vector3d mean_speed = 0.5 * (before.velocity_world_m_s + now.velocity_world_m_s);
    EXPECT_LT((displacement_m / kStep_s - mean_speed).norm(), 1e-9);
    const Eigen::Vector3d gained = now.velocity_world_m_s - before.velocity_world_m_s;
    EXPECT_LT((gained / kStep_s - now.acceleration_world_m_s2).norm(), 1e-9);
    const Eigen::Vector3d force =
        now.specificForce_body_m_s2() +
        kDrag_per_s * now.T_world_body.linear().transpose() * before.velocity_world_m_s;
    EXPECT_LT(force.head<2>().norm(), 1e-9) << "the rotors push along z alone";
    EXPECT_LT((now.angular_rate_body_rad_s - before.angular_rate_body_rad_s).norm(), 0.2);
  }
}

TEST(DroneDynamics, EqualStepsGiveEqualStates) {
  DroneDynamics a = hovering(), b = hovering();
  for (int i = 0; i < 100; ++i) {
    a.advance(0.01, {0.3, -0.2, 0.1, 0.4});
    b.advance(0.01, {0.3, -0.2, 0.1, 0.4});
  }
  EXPECT_EQ(a.state().T_world_body.matrix(), b.state().T_world_body.matrix());
}

}  // namespace
}  // namespace ardrone_vslam
