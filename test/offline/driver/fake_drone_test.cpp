// SPDX-License-Identifier: BSD-3-Clause
#include "driver/fake_drone.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "driver/fake_driver_setup.hpp"
#include "support/worlds.hpp"

namespace ardrone_vslam {
namespace {

using State = DronePacket::State;

using test::room;

FakeDroneOptions calm() {
  FakeDroneOptions options;
  options.profile.name = "truth";
  options.wind_m_s = 0;
  return options;
}

DroneMoment after(FakeDrone& drone, double seconds) {
  DroneMoment moment = drone.advance();
  for (int i = 1; i < seconds * kPacketRate_hz; ++i) moment = drone.advance();
  return moment;
}

TEST(FakeDrone, TakesOffFliesAndLandsAndItsPacketsSayIt) {
  FakeDrone drone(room(), calm());
  EXPECT_EQ(drone.command({1, 0, 0, 0}), "");
  DroneMoment moment = after(drone, 1);
  EXPECT_EQ(moment.packet.state, State::kLanded);
  EXPECT_NEAR(moment.packet.altitude_m, 0.1, 1e-3);
  EXPECT_EQ(drone.takeOff(), "");
  EXPECT_EQ(after(drone, 0.2).packet.state, State::kTakingOff);
  moment = after(drone, 5);
  EXPECT_EQ(moment.packet.state, State::kHovering) << "takeoff forgets the command before";
  EXPECT_NEAR(moment.packet.altitude_m, 1.05, 0.1);
  const Eigen::Isometry3d before = moment.state.T_world_body;
  drone.command({0.5, 0, 0, 0});
  moment = after(drone, 1);
  EXPECT_EQ(moment.packet.state, State::kFlying);
  drone.command({});
  moment = after(drone, 3);
  EXPECT_EQ(moment.packet.state, State::kHovering);
  const Eigen::Vector3d displacement_m =
      (before.inverse() * moment.state.T_world_body).translation();
  EXPECT_GT(displacement_m.x(), 0.5);
  EXPECT_NEAR(displacement_m.y(), 0, 1e-3);
  EXPECT_EQ(drone.land(), "");
  EXPECT_EQ(after(drone, 0.2).packet.state, State::kLanding);
  EXPECT_EQ(after(drone, 5).packet.state, State::kLanded);
}

TEST(FakeDrone, WhatIsNotFiniteMakesItHover) {
  FakeDrone drone(room(), calm());
  drone.takeOff();
  after(drone, 5);
  drone.command({1, 0, 0, 0});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(drone.command({0, nan, 0, 0}).find("not finite"), std::string::npos);
  EXPECT_EQ(after(drone, 0.1).packet.state, State::kHovering);
}

TEST(FakeDrone, ResetInFlightIsAnEmergencyUntilTheNextOne) {
  FakeDrone drone(room(), calm());
  EXPECT_EQ(drone.reset(), "");
  EXPECT_EQ(drone.takeOff(), "") << "on the floor a reset does nothing";
  after(drone, 5);
  drone.reset();
  EXPECT_EQ(after(drone, 1).packet.state, State::kUnknown);
  EXPECT_NE(drone.takeOff().find("reset"), std::string::npos);
  drone.reset();
  EXPECT_EQ(after(drone, 0.1).packet.state, State::kLanded);
  EXPECT_EQ(drone.takeOff(), "");
}

TEST(FakeDrone, AutopilotWaitsAndThenFliesItsFlightAlone) {
  FakeDroneOptions options = calm();
  options.autopilot = "laps";
  FakeDrone drone(room(), options);
  const auto flight = makeFlight("laps", {});
  EXPECT_EQ(after(drone, 1).state.T_world_body.matrix(), flight->pose(0).matrix());
  drone.beginFlight();
  const DroneMoment moment = after(drone, 3);
  EXPECT_NEAR(moment.t_s, 3, 1e-9);
  EXPECT_EQ(moment.state.T_world_body.matrix(), flight->pose(moment.t_s).matrix());
  EXPECT_NE(drone.command({}).find("the autopilot flies laps"), std::string::npos);
  EXPECT_NE(drone.land(), "");
  EXPECT_EQ(drone.start_m(), Eigen::Vector3d(flight->pose(0).translation().x(),
                                             flight->pose(0).translation().y(), 0));
}

TEST(FakeDrone, WindIsOfItsSeed) {
  FakeDroneOptions options = calm();
  options.wind_m_s = 0.3;
  FakeDrone a(room(), options), b(room(), options);
  options.seed = 1;
  FakeDrone c(room(), options);
  Eigen::Vector3d place[3];
  int i = 0;
  for (FakeDrone* drone : {&a, &b, &c}) {
    drone->takeOff();
    place[i++] = after(*drone, 15).state.T_world_body.translation();
  }
  EXPECT_EQ(place[0], place[1]);
  EXPECT_GT((place[0] - place[2]).norm(), 0.02);
  EXPECT_LT((place[0] - place[2]).norm(), 3);
}

TEST(FakeDrone, NoneIsNoAutopilotAndNoFault) {
  FakeDriverConfig config;
  for (const std::string none : {"", "none"}) {
    config.autopilot = config.faults = none;
    EXPECT_FALSE(hasAutopilot(config));
    EXPECT_EQ(droneOf(config).autopilot, "");
    EXPECT_EQ(nameList(faultsOf(config)), "none");
  }
  config.autopilot = "hover";
  config.faults = "bursts, mirrored_yaw";
  EXPECT_EQ(droneOf(config).autopilot, "hover");
  EXPECT_EQ(nameList(faultsOf(config)), "mirrored_yaw, bursts");
}

std::string refusalOf(const FakeDriverConfig& config) {
  try {
    checkNames(config);
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return {};
}

TEST(FakeDrone, NamesTheParameterWithAnUnknownNameAndWhatIsKnown) {
  FakeDriverConfig config;
  EXPECT_EQ(refusalOf(config), "");
  config.autopilot = "fly";
  std::string said = refusalOf(config);
  EXPECT_EQ(said.find("autopilot: there is no flight 'fly'; known are laps,"), 0U) << said;
  EXPECT_NE(said.find(", none"), std::string::npos) << said;
  config = {};
  config.faults = "bursts,foo";
  said = refusalOf(config);
  EXPECT_EQ(said.find("faults: the driver has no fault 'foo'; known are all,"), 0U) << said;
  EXPECT_NE(said.find(", none"), std::string::npos) << said;
  config = {};
  config.camera = "rear";
  EXPECT_EQ(refusalOf(config).find("camera: there is no camera 'rear'; known are front,"), 0U);
}

TEST(FakeDrone, RefusesWhatCannotBe) {
  FakeDroneOptions options = calm();
  options.start = FlightStart{3.9, 0, 0};
  EXPECT_THROW(FakeDrone(room(), options), std::invalid_argument);
  options.start = FlightStart{0, 0, std::nan("")};
  EXPECT_THROW(FakeDrone(room(), options), std::invalid_argument);
  options = calm();
  options.autopilot = "barrel_roll";
  EXPECT_THROW(FakeDrone(room(), options), std::invalid_argument);
}

}  // namespace
}  // namespace ardrone_vslam
