// SPDX-License-Identifier: BSD-3-Clause
// Every flight's truth against the laws of motion, and each flight against what it promises.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/yaw.hpp"
#include "world/flight/world_flight.hpp"
#include "world/scene/world_corridor.hpp"
#include "world/scene/world_furniture.hpp"
#include "world/world.hpp"

namespace ardrone_vslam {
namespace {

using test::yawOf;

const Eigen::Vector3d kGravity_world(0, 0, -kGravity_m_s2);

class EachFlight : public testing::TestWithParam<std::string> {
 protected:
  const FlightInfo& info() const { return flightInfo(GetParam()); }
  std::unique_ptr<Flight> flight() const { return makeFlight(GetParam(), std::nullopt); }
};

std::vector<std::string> allNames() {
  std::vector<std::string> names;
  for (const auto& one : flights()) names.push_back(one.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(All, EachFlight, testing::ValuesIn(allNames()),
                         [](const auto& one) { return one.param; });

class LeaningFlight : public EachFlight {};

std::vector<std::string> namesOfDrones() {
  std::vector<std::string> names = allNames();
  names.erase(std::remove(names.begin(), names.end(), "drive"), names.end());  // it has wheels
  return names;
}

INSTANTIATE_TEST_SUITE_P(All, LeaningFlight, testing::ValuesIn(namesOfDrones()),
                         [](const auto& one) { return one.param; });

TEST_P(EachFlight, BeginsAtRestAndLevel) {
  const FlightState first = flight()->state(0);
  EXPECT_LT(first.velocity_world_m_s.norm(), 1e-6);
  EXPECT_LT(first.acceleration_world_m_s2.norm(), 1e-4);
  EXPECT_LT(first.angular_rate_body_rad_s.norm(), 1e-3);  // the tilt sees 10 ms ahead
  EXPECT_LT((first.specificForce_body_m_s2() - Eigen::Vector3d(0, 0, kGravity_m_s2)).norm(), 1e-4);
}

TEST_P(EachFlight, DerivativesAreThoseOfThePose) {
  constexpr double kStep_s = 0.004;
  const auto drone = flight();
  for (double t = 0.3; t < info().duration_s; t += 0.37) {
    const FlightState now = drone->state(t);
    const Eigen::Isometry3d before = drone->pose(t - kStep_s), after = drone->pose(t + kStep_s);
    EXPECT_TRUE(now.T_world_body.isApprox(drone->pose(t), 1e-12));
    EXPECT_LT(
        ((after.translation() - before.translation()) / (2 * kStep_s) - now.velocity_world_m_s)
            .norm(),
        3e-4)
        << t;
    const Eigen::AngleAxisd turn(before.linear().transpose() * after.linear());
    EXPECT_LT((turn.axis() * turn.angle() / (2 * kStep_s) - now.angular_rate_body_rad_s).norm(),
              2e-3)
        << t;
  }
}

TEST_P(LeaningFlight, LeansAsItsAccelerationAsks) {
  const auto drone = flight();
  for (double t = 0; t < info().duration_s; t += 0.31) {
    const FlightState now = drone->state(t);
    // The rotors push along the body's z; air brakes against the speed.
    const Eigen::Vector3d thrust_world =
        now.acceleration_world_m_s2 + kDrag_per_s * now.velocity_world_m_s - kGravity_world;
    const Eigen::Vector3d thrust_body = now.T_world_body.linear().transpose() * thrust_world;
    EXPECT_LT(thrust_body.head<2>().norm(), 2e-3) << t;
    EXPECT_GT(thrust_body.z(), 5);
  }
}

/// What the inertial sensors tell, integrated for ten seconds at 1 kHz, leads along the truth.
TEST_P(EachFlight, InertialQuantitiesIntegrateToTheTruth) {
  constexpr double kStep_s = 1e-3;
  const auto drone = flight();
  for (const double begin_s : {0.0, 18.0, 30.0}) {
    FlightState state = drone->state(begin_s);
    Eigen::Matrix3d R_world_body = state.T_world_body.linear();
    Eigen::Vector3d velocity = state.velocity_world_m_s,
                    position = state.T_world_body.translation();
    for (int i = 0; i < 10000; ++i) {
      const FlightState middle = drone->state(begin_s + (i + 0.5) * kStep_s);
      const Eigen::Vector3d turn = middle.angular_rate_body_rad_s * kStep_s;
      const Eigen::AngleAxisd half(turn.norm() / 2, turn.normalized());
      if (turn.norm() > 0) R_world_body = R_world_body * half;
      const Eigen::Vector3d acceleration =
          R_world_body * middle.specificForce_body_m_s2() + kGravity_world;
      if (turn.norm() > 0) R_world_body = R_world_body * half;
      position += velocity * kStep_s + 0.5 * acceleration * kStep_s * kStep_s;
      velocity += acceleration * kStep_s;
    }
    const FlightState end = drone->state(begin_s + 10);
    EXPECT_LT((velocity - end.velocity_world_m_s).norm(), 1e-3) << begin_s;
    EXPECT_LT((position - end.T_world_body.translation()).norm(), 3e-3) << begin_s;
    EXPECT_LT(Eigen::AngleAxisd(R_world_body.transpose() * end.T_world_body.linear()).angle(),
              1e-4);
  }
}

TEST_P(EachFlight, KeepsClearOfEverything) {
  const auto drone = flight();
  const World world = makeWorld(info().world, "steady", 0);
  for (double t = 0; t < info().duration_s; t += 0.5) {
    const FlightState now = drone->state(t);
    const Scene scene = world.at(t);
    for (int i = 0; i < 16; ++i) {
      const double angle = 2 * M_PI * i / 16;
      for (const double up : {-1.0, -0.3, 0.0, 0.3, 1.0}) {
        const Eigen::Vector3d ray(std::cos(angle), std::sin(angle), up);
        const auto range = rangeAlong(scene, now.T_world_body.translation(), ray.normalized());
        ASSERT_TRUE(range.has_value()) << "a hole in the world";
        EXPECT_GT(*range, 0.25) << "at " << t << " s";
      }
    }
    EXPECT_LT(now.velocity_world_m_s.norm(), 2.5);
    EXPECT_LT(std::acos(now.T_world_body.linear()(2, 2)), 20 * M_PI / 180);
  }
}

TEST(Flights, TheCorridorIsFlownOutAndBackBackwards) {
  const auto flight = makeFlight("corridor", std::nullopt);
  const auto turning = makeFlight("corridor_turn", std::nullopt);
  const auto x = [&](const Flight& f, double t) { return f.pose(t).translation().x(); };
  EXPECT_NEAR(x(*flight, 35) - x(*flight, 0), 30, 0.4);
  EXPECT_NEAR(x(*flight, 71), x(*flight, 0), 0.4);
  EXPECT_NEAR(x(*turning, 77), x(*turning, 0), 0.4);
  EXPECT_LT(flight->state(50).velocity_world_m_s.x(), -0.9);
  EXPECT_LT(turning->state(60).velocity_world_m_s.x(), -0.9);
  for (double t = 0; t < 71; t += 0.5) EXPECT_LT(std::abs(yawOf(flight->pose(t))), 0.1);
  EXPECT_GT(std::abs(yawOf(turning->pose(60))), M_PI - 0.1);
}

TEST(Flights, WhatDrivesStaysLevelAndGoesWhereItsNosePoints) {
  const auto flight = makeFlight("drive", std::nullopt);
  for (double t = 0; t < 60; t += 0.3) {
    const FlightState now = flight->state(t);
    EXPECT_NEAR(now.T_world_body.linear()(2, 2), 1, 1e-12);
    const Eigen::Vector3d velocity = now.T_world_body.linear().transpose() * now.velocity_world_m_s;
    EXPECT_LT(velocity.tail<2>().norm(), 1e-5) << t;
    EXPECT_GT(velocity.x(), -1e-6) << t;
  }
}

TEST(Flights, PureYawTurnsWithoutMoving) {
  const auto flight = makeFlight("pure_yaw", std::nullopt);
  double fastest = 0;
  for (double t = 0; t < 46; t += 0.1) {
    EXPECT_EQ((flight->pose(t).translation() - flight->pose(0).translation()).norm(), 0);
    EXPECT_NEAR(flight->pose(t).linear()(2, 2), 1, 1e-12);
    fastest = std::max(fastest, std::abs(flight->state(t).angular_rate_body_rad_s.z()));
  }
  EXPECT_NEAR(fastest, M_PI / 2.2, 0.01);
}

TEST(Flights, MappingTurnLooksAllAroundFirst) {
  const auto flight = makeFlight("mapping_turn", std::nullopt);
  const auto laps = makeFlight("laps", std::nullopt);
  double turned = 0;
  for (double t = 0; t < 22; t += 0.1) {
    turned += std::remainder(yawOf(flight->pose(t + 0.1)) - yawOf(flight->pose(t)), 2 * M_PI);
    EXPECT_LT((flight->pose(t).translation() - flight->pose(0).translation()).norm(), 0.1);
  }
  EXPECT_NEAR(turned, 2 * M_PI, 0.01);
  EXPECT_TRUE(flight->pose(40).isApprox(laps->pose(18), 1e-6));
}

TEST(Flights, FastBlurIsFast) {
  const auto flight = makeFlight("fast_blur", std::nullopt);
  double fastest = 0, quickest = 0;
  for (double t = 0; t < 60; t += 0.05) {
    const FlightState now = flight->state(t);
    if (t < 18) {
      EXPECT_LT(now.velocity_world_m_s.norm(), 1.2);
    }
    fastest = std::max(fastest, now.velocity_world_m_s.norm());
    quickest = std::max(quickest, now.angular_rate_body_rad_s.norm());
  }
  EXPECT_GT(fastest, 1.8);
  EXPECT_GT(quickest, 2);
  EXPECT_GT(flightInfo("fast_blur").shutter_s, 0);
}

TEST(Flights, HoverStaysWhereItIs) {
  const auto flight = makeFlight("hover", FlightStart{1, -1, 2});
  EXPECT_NEAR(yawOf(flight->pose(0)), 2, 1e-6);
  for (double t = 0; t < 60; t += 0.5) {
    EXPECT_LT((flight->pose(t).translation() - Eigen::Vector3d(1, -1, 1.2)).norm(), 0.25);
  }
}

TEST(Flights, TheTableIsAStepOfTheRangeAndNotOfTheHeight) {
  const auto flight = makeFlight("table", std::nullopt);
  const World world = makeWorld("furnished", "steady", 0);
  double above_table_s = 0;
  for (double t = 0; t < 60; t += 0.05) {
    const Eigen::Isometry3d pose = flight->pose(t);
    const Eigen::Vector3d down = -pose.linear().col(2);
    const double to_top = (kTableHeight_m - pose.translation().z()) / down.z();
    const Eigen::Vector3d at = pose.translation() + to_top * down;
    const bool above =
        std::abs(at.x()) < kTableLength_m / 2 && std::abs(at.y()) < kTableWidth_m / 2;
    const bool beside =
        std::abs(at.x()) > kTableLength_m / 2 + 0.2 || std::abs(at.y()) > kTableWidth_m / 2 + 0.2;
    const auto range = world.rangeBelow_m(pose, t);
    ASSERT_TRUE(range.has_value());
    if (above) {
      EXPECT_NEAR(*range, to_top, 1e-9) << t;
      above_table_s += 0.05;
    } else if (beside) {
      EXPECT_NEAR(*range, -pose.translation().z() / down.z(), 1e-9) << t;
    }
  }
  EXPECT_GT(above_table_s, 8);
}

TEST(Flights, RefuseAStartThatTheyCannotHave) {
  EXPECT_THROW(makeFlight("corridor", FlightStart{}), std::invalid_argument);
  EXPECT_THROW(makeFlight("table", FlightStart{}), std::invalid_argument);
  EXPECT_THROW(makeFlight("hover", FlightStart{5, 0, 0}), std::invalid_argument);
}

}  // namespace
}  // namespace ardrone_vslam
