// SPDX-License-Identifier: BSD-3-Clause
// The package's own observer on simulated flights, whose truth is known.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "ardrone_vslam/drone_observer.hpp"
#include "driver/drone_flight.hpp"
#include "support/shipped_profiles.hpp"
#include "world/world.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::int64_t kBegin_ns = 1'400'000'000'000'000'000;

NavdataReading readingOf(const DronePacket& packet, std::int64_t stamp_ns) {
  NavdataReading reading;
  reading.stamp_ns = stamp_ns;
  reading.measured.R_odom_base = packet.R_odom_base;
  reading.measured.flow_base_m_s = packet.velocity_base_m_s.head<2>();
  reading.measured.force_base_m_s2 = packet.specific_force_base_m_s2;
  reading.measured.height_m = packet.altitude_m;
  return reading;
}

DroneFlight fly(const std::string& name, const std::string& profile, std::uint64_t seed,
                double seconds = 0) {
  const FlightInfo& info = flightInfo(name);
  return flyDrone(*makeFlight(name, std::nullopt), makeWorld(info.world, info.light, 1),
                  seconds > 0 ? seconds : info.duration_s, kBegin_ns, test::shippedProfile(profile),
                  seed);
}

std::vector<NavdataReading> readingsOf(const DroneFlight& flight) {
  std::vector<NavdataReading> readings;
  for (std::size_t i = 0; i < flight.packets.size(); ++i)
    readings.push_back(readingOf(flight.packets[i], flight.truth.poses()[i].stamp_ns));
  return readings;
}

class DroneObserverFlight : public ::testing::Test {
 protected:
  void observe(const std::vector<NavdataReading>& readings) {
    observer_ = DroneObserver{};
    states_.clear();
    refused_ = 0;
    for (const NavdataReading& reading : readings) {
      if (observer_.push(reading, states_) != OdometryBuffer::Push::kAccepted) ++refused_;
    }
    observer_.flush(states_);
    for (std::size_t i = 1; i < states_.size(); ++i)
      ASSERT_GT(states_[i].stamp_ns, states_[i - 1].stamp_ns) << i;
  }
  /// Of a state's position, from the truth's first.
  static Eigen::Vector3d errorOf_m(const OdometryState& state, const DroneFlight& flight) {
    const Eigen::Vector3d begin_m = flight.truth.poses().front().T_frame_body.translation();
    Eigen::Vector3d truth_m = flight.truth.at(state.stamp_ns).translation();
    truth_m.head<2>() -= begin_m.head<2>();
    return state.T_odom_base.translation() - truth_m;
  }
  double worst_m(const DroneFlight& flight, int first, int count) const {
    double worst = 0;
    for (const OdometryState& state : states_)
      worst = std::max(worst, errorOf_m(state, flight).segment(first, count).norm());
    return worst;
  }
  /// Squared error over what the covariance says, a coordinate; each second's, their mean.
  double nees(const DroneFlight& flight) const {
    double sum = 0;
    int count = 0;
    for (std::size_t i = 200; i < states_.size(); i += 200, ++count) {
      const Eigen::Vector3d error_m = errorOf_m(states_[i], flight);
      const Eigen::Matrix3d P = states_[i].covariance.topLeftCorner<3, 3>();
      sum += error_m.dot(P.ldlt().solve(error_m)) / 3;
    }
    return sum / count;
  }
  std::uint64_t count(OdometryFault fault) const {
    return observer_.faults()[static_cast<std::size_t>(fault)];
  }

  DroneObserver observer_;
  std::vector<OdometryState> states_;
  int refused_ = 0;
};

TEST_F(DroneObserverFlight, SoundSensorsGiveTheTruth) {
  const DroneFlight flight = fly("laps", "truth", 1);
  observe(readingsOf(flight));
  ASSERT_EQ(states_.size(), flight.packets.size());
  EXPECT_LT(worst_m(flight, 0, 3), 0.05);
  EXPECT_EQ(observer_.faults(), OdometryFaultCounts{});
}

TEST_F(DroneObserverFlight, TheCovarianceIsHonest) {
  double sum = 0;
  int flights = 0;
  for (const char* name : {"laps", "hover", "table"}) {
    for (const std::uint64_t seed : {1, 2, 3, 4}) {
      const DroneFlight flight = fly(name, "drone", seed);
      observe(readingsOf(flight));
      const double one = nees(flight);
      EXPECT_LT(one, 4) << name << ' ' << seed;
      sum += one;
      ++flights;
    }
  }
  EXPECT_GT(sum / flights, 0.3);
  EXPECT_LT(sum / flights, 1.5);
}

TEST_F(DroneObserverFlight, ATableIsToldFromAClimb) {
  const DroneFlight flight = fly("table", "drone", 5);
  observe(readingsOf(flight));
  // Of the heights themselves.
  int steps = 0;
  bool was_above = false;
  double worst_m = 0;
  for (std::size_t i = 0; i < flight.packets.size(); ++i) {
    const double z_m = flight.truth.poses()[i].T_frame_body.translation().z();
    const double floor_m = z_m - flight.packets[i].altitude_m;
    worst_m = std::max(worst_m, floor_m);
    const bool is_above = was_above ? floor_m > 0.2 : floor_m > 0.5;
    if (is_above != was_above) ++steps;
    was_above = is_above;
  }
  EXPECT_GT(worst_m, 0.7);
  EXPECT_EQ(count(OdometryFault::kTableStep), static_cast<std::uint64_t>(steps));
  EXPECT_GE(steps, 2);
  EXPECT_LT(DroneObserverFlight::worst_m(flight, 2, 1), 0.06);
}

TEST_F(DroneObserverFlight, PacketsThatCameTogetherAreSpread) {
  const DroneFlight flight = fly("laps", "drone", 1, 20);
  auto readings = readingsOf(flight);
  observe(readings);
  const std::vector<OdometryState> sound = states_;
  for (std::size_t i = 3; i + 6 < readings.size(); i += 12)
    for (std::size_t k = i; k < i + 5; ++k) readings[k].stamp_ns = readings[i + 5].stamp_ns;
  observe(readings);
  ASSERT_EQ(states_.size(), sound.size());
  EXPECT_GT(count(OdometryFault::kBurst), 300U);
  for (std::size_t i = 0; i < sound.size(); ++i) {
    ASSERT_NEAR(static_cast<double>(states_[i].stamp_ns - sound[i].stamp_ns), 0, 10) << i;
    ASSERT_LT((states_[i].T_odom_base.translation() - sound[i].T_odom_base.translation()).norm(),
              1e-6);
  }
}

TEST_F(DroneObserverFlight, TheOrderOfNavdataAndImuDoesNotMatter) {
  const DroneFlight flight = fly("laps", "drone", 1, 5);
  auto readings = readingsOf(flight);
  for (std::size_t i = 3; i + 6 < readings.size(); i += 12)
    for (std::size_t k = i; k < i + 5; ++k) readings[k].stamp_ns = readings[i + 5].stamp_ns;
  std::vector<std::vector<OdometryState>> runs;
  for (const std::size_t late : {0, 1, 7}) {
    DroneObserver observer;
    std::vector<OdometryState> states;
    for (std::size_t i = 0; i < readings.size() + late; ++i) {
      if (i < readings.size()) observer.push(readings[i], states);
      if (i < late) continue;
      const DronePacket& packet = flight.packets[i - late];
      observer.push(DroneImu{readings[i - late].stamp_ns, packet.angular_rate_base_rad_s,
                             packet.specific_force_base_m_s2},
                    states);
    }
    observer.flush(states);
    runs.push_back(states);
  }
  ASSERT_EQ(runs[0].size(), readings.size());
  for (const auto& run : runs) {
    ASSERT_EQ(run.size(), runs[0].size());
    for (std::size_t i = 0; i < run.size(); ++i) {
      ASSERT_EQ(run[i].T_odom_base.matrix(), runs[0][i].T_odom_base.matrix()) << i;
      ASSERT_EQ(run[i].twist_base, runs[0][i].twist_base) << i;
    }
  }
  const Eigen::Vector3d turn = runs[0][500].twist_base.tail<3>();
  EXPECT_EQ(turn, flight.packets[500].angular_rate_base_rad_s);
}

TEST_F(DroneObserverFlight, ATurnedWorldGivesATurnedFlight) {
  const DroneFlight flight = fly("laps", "drone", 2, 20);
  auto readings = readingsOf(flight);
  observe(readings);
  const std::vector<OdometryState> before = states_;
  const Eigen::Isometry3d turn(Eigen::AngleAxisd(2.5, Eigen::Vector3d::UnitZ()));
  for (auto& reading : readings)
    reading.measured.R_odom_base = turn.linear() * reading.measured.R_odom_base;
  observe(readings);
  ASSERT_EQ(states_.size(), before.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    ASSERT_TRUE(states_[i].T_odom_base.isApprox(turn * before[i].T_odom_base, 1e-6)) << i;
    const Eigen::Matrix3d P = before[i].covariance.topLeftCorner<3, 3>();
    ASSERT_TRUE((states_[i].covariance.topLeftCorner<3, 3>())
                    .isApprox(turn.linear() * P * turn.linear().transpose(), 1e-6));
  }
}

TEST_F(DroneObserverFlight, BadInputIsRefusedAndDoesNoHarm) {
  const DroneFlight flight = fly("laps", "drone", 1, 20);
  const auto readings = readingsOf(flight);
  observe(readings);
  const std::vector<OdometryState> sound = states_;
  auto bad = readings;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  bad.insert(bad.begin() + 1000, 6, readings[999]);
  bad[1000].measured.height_m = nan;
  bad[1001].measured.R_odom_base(0, 0) = nan;
  bad[1002].measured.flow_base_m_s.x() = 1e5;
  bad[1003].measured.force_base_m_s2.z() = 1e5;
  bad[1004].measured.height_m = 1e9;
  bad[1005].stamp_ns -= 500'000'000;
  observe(bad);
  EXPECT_EQ(refused_, 6);
  ASSERT_EQ(states_.size(), sound.size());
  for (std::size_t i = 0; i < sound.size(); ++i)
    ASSERT_EQ(states_[i].T_odom_base.matrix(), sound[i].T_odom_base.matrix()) << i;
}

TEST_F(DroneObserverFlight, AHoleIsCountedAndWidensTheCovariance) {
  const DroneFlight flight = fly("laps", "drone", 1, 30);
  auto readings = readingsOf(flight);
  readings.erase(readings.begin() + 2000, readings.begin() + 2600);
  observe(readings);
  EXPECT_EQ(count(OdometryFault::kHole), 1U);
  EXPECT_GT(states_[2000].covariance(0, 0), states_[1999].covariance(0, 0) + 1);
  EXPECT_LT(nees(flight), 3);
  EXPECT_LT(worst_m(flight, 2, 1), 0.1) << "the height is measured again";
}

TEST_F(DroneObserverFlight, StampsThatBeginAnewBeginANewFlight) {
  const auto readings = readingsOf(fly("laps", "drone", 1, 10));
  observe(readings);
  const std::vector<OdometryState> once = states_;
  auto twice = readings;
  twice.insert(twice.end(), readings.begin(), readings.end());
  DroneObserver observer;
  std::vector<OdometryState> states;
  for (const auto& reading : twice) observer.push(reading, states);
  observer.flush(states);
  EXPECT_EQ(observer.faults()[static_cast<std::size_t>(OdometryFault::kRestart)], 1U);
  ASSERT_GE(states.size(), once.size());
  const std::size_t second = states.size() - once.size();
  for (std::size_t i = 0; i < once.size(); ++i)
    ASSERT_EQ(states[second + i].T_odom_base.matrix(), once[i].T_odom_base.matrix()) << i;
}

TEST_F(DroneObserverFlight, ADroneSwitchedOnAnewDoesNotTurnTheWorld) {
  const DroneFlight flight = fly("laps", "truth", 1, 20);
  auto readings = readingsOf(flight);
  for (std::size_t i = 2000; i < readings.size(); ++i) {
    readings[i].measured.R_odom_base =
        Eigen::AngleAxisd(1.5, Eigen::Vector3d::UnitZ()) * readings[i].measured.R_odom_base;
  }
  observe(readings);
  EXPECT_EQ(count(OdometryFault::kReset), 1U);
  EXPECT_LT(worst_m(flight, 0, 2), 0.1);
}

TEST_F(DroneObserverFlight, OnTheGroundItStandsStill) {
  NavdataReading reading;
  reading.stamp_ns = kBegin_ns;
  reading.is_standing = true;
  reading.measured.R_odom_base =
      Eigen::AngleAxisd(0.05, Eigen::Vector3d::UnitX()).toRotationMatrix();
  reading.measured.force_base_m_s2 =
      reading.measured.R_odom_base.transpose() * Eigen::Vector3d(0, 0, 9.7);
  std::vector<NavdataReading> readings;
  for (int i = 0; i < 12000; ++i, reading.stamp_ns += 5'000'000) readings.push_back(reading);
  observe(readings);
  EXPECT_EQ(states_.back().T_odom_base.translation(), Eigen::Vector3d::Zero());
  EXPECT_TRUE(states_.back().twist_base.isZero(0));
  EXPECT_LT(states_.back().covariance(0, 0), 1e-4);
}

}  // namespace
}  // namespace ardrone_vslam
