// SPDX-License-Identifier: BSD-3-Clause
#include "window/window_state.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "ardrone_vslam/rotation.hpp"
#include "simulation/random_source.hpp"
#include "support/eigenvalues.hpp"
#include "support/odometry_states.hpp"
#include "support/odometry_window.hpp"

namespace ardrone_vslam {
namespace {

using test::odometryOfFrame;

OdometryWindow circling(int frames) {
  OdometryWindow state;
  for (int i = 0; i < frames; ++i) {
    const double turn = 0.1 * i;
    const OdometryState odometry =
        odometryOfFrame(i, {std::sin(turn), 1 - std::cos(turn), 0}, turn);
    state.add(odometry);
  }
  return state;
}

void expectHonest(const WindowState& state) {
  const Eigen::MatrixXd& P = state.covariance();
  EXPECT_LT((P - P.transpose()).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_GT(test::leastEigenvalue(P), -1e-12);
}

TEST(WindowState, FollowsTheOdometryAndGrowsLessSure) {
  const OdometryWindow state = circling(20);
  EXPECT_LT(
      (state.frames().back().position_map - Eigen::Vector3d(std::sin(1.9), 1 - std::cos(1.9), 0))
          .norm(),
      1e-9);
  double last = 0;
  for (std::size_t i = 0; i < state.frames().size(); ++i) {
    const int at = state.frameCoordinate(i);
    const double variance = state.covariance().block<3, 3>(at, at).trace();
    EXPECT_GT(variance, last);
    last = variance;
  }
  expectHonest(state);
}

TEST(WindowState, TheOdometrysOwnCovarianceIsUsedWhereItGivesOne) {
  const auto grown = [](double variance_m2) {
    OdometryWindow state;
    OdometryState first = odometryOfFrame(0, {0, 0, 0});
    OdometryState second = odometryOfFrame(1, {0, 0, 0});
    if (variance_m2 > 0) {
      first.covariance.diagonal().head<3>().setConstant(0.5);
      second.covariance.diagonal().head<3>().setConstant(0.5 + variance_m2);
    }
    state.add(first);
    state.add(second);
    const int at = state.frameCoordinate(1);
    return state.covariance()(at, at) - state.covariance()(at - 6, at - 6);
  };
  EXPECT_GT(grown(4.0) - grown(0), 3.9);
}

TEST(WindowState, ErrorsThatAreStatesAreNoWhiteNoiseInTheOdometrysCovariance) {
  const OdometryNoiseConfig config;
  constexpr double kSpeed_m_s = 1;
  constexpr double kWhite_m_per_sqrt_s = 0.05;
  const auto odometry = [&config](int frame) {
    const double t_s = 0.1 * frame;
    OdometryState state = odometryOfFrame(frame, {kSpeed_m_s * t_s, 0, 0});
    const double time_s = config.velocity_bias_time_s;
    const double by_bias_m2 = 2 * std::pow(config.velocity_bias_m_s, 2) * time_s *
                              (t_s + time_s * std::expm1(-t_s / time_s));
    const double by_scale_m2 = std::pow(config.scale_sigma * kSpeed_m_s * t_s, 2);
    state.covariance.diagonal().head<3>().setConstant(1e-6 + by_bias_m2 + by_scale_m2 +
                                                      std::pow(kWhite_m_per_sqrt_s, 2) * t_s);
    return state;
  };
  OdometryWindow state(config);
  state.add(odometry(0));
  for (int frame = 1; frame <= 600; ++frame) {
    state.add(odometry(frame));
    if (state.frames().size() > 2) state.removeFrame(0);
  }
  const double after_a_minute_m2 =
      state.relativeCovariance(state.frameCoordinate(0), state.frameCoordinate(1))(1, 1);
  // Across the way, 0.1 s: white noise, and what velocity bias and attitude leave in doubt there.
  EXPECT_LT(after_a_minute_m2, 2 * std::pow(kWhite_m_per_sqrt_s, 2) * 0.1);
  EXPECT_GT(after_a_minute_m2, std::pow(config.walk_m_per_sqrt_s, 2) * 0.1);
}

TEST(WindowState, StaysSymmetricAndPositiveThroughRandomUpdates) {
  RandomSource random(4);
  OdometryWindow state = circling(12);
  for (int round = 0; round < 60; ++round) {
    Information information = Information::between(state.frameCoordinate(0),
                                                   state.frameCoordinate(state.frames().size()));
    const auto size = information.vector.size();
    for (int row = 0; row < 5; ++row) {
      Eigen::VectorXd h(size);
      for (Eigen::Index k = 0; k < size; ++k) h(k) = 100 * random.normal();
      information.matrix += h * h.transpose();
      information.vector += h * random.normal();
    }
    ASSERT_TRUE(state.update(information));
    if (round % 4 == 0) state.makeAnchor(0);
    if (round % 10 == 9) state.removeAnchor(state.anchors().size() / 2);
    const double turn = 0.1 * (12 + round);
    state.add(odometryOfFrame(12 + round, {std::sin(turn), 1 - std::cos(turn), 0}, turn));
    if (state.frames().size() > 12) state.removeFrame(3);
    expectHonest(state);
  }
}

TEST(WindowState, WhatIsLearnedOfTheNewestFrameCorrectsTheAnchorsThatShareItsError) {
  OdometryWindow state = circling(6);
  state.makeAnchor(0);
  state.makeAnchor(0);
  const Eigen::MatrixXd P = state.covariance();
  const int newest = state.frameCoordinate(state.frames().size() - 1);
  Information information = Information::between(newest, newest + 3);
  constexpr double kVariance = 1e-4;
  const Eigen::Vector3d innovation(0.01, -0.02, 0.005);
  information.matrix = Eigen::Matrix3d::Identity() / kVariance;
  information.vector = innovation / kVariance;
  const std::vector<Clone> before = state.anchors();
  ASSERT_TRUE(state.update(information));
  const Eigen::Matrix3d S = P.block<3, 3>(newest, newest) + kVariance * Eigen::Matrix3d::Identity();
  const Eigen::VectorXd error = P.middleCols<3>(newest) * S.inverse() * innovation;
  for (std::size_t i = 0; i < 2; ++i) {
    const int at = state.anchorCoordinate(i);
    const Clone& anchor = state.anchors()[i];
    EXPECT_LT((anchor.position_map - before[i].position_map - error.segment<3>(at)).norm(), 1e-9);
    EXPECT_NEAR(anchor.stretch, 1 - error(WindowState::kScale) - error(at + 6), 1e-9);
  }
  EXPECT_GT(error.segment<3>(state.anchorCoordinate(1)).norm(), 1e-4) << "it shares something";
  expectHonest(state);
}

TEST(WindowState, ABiasLearnedInTheClimbDoesNotStretchTheWayForward) {
  OdometryWindow state;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  const auto fly = [&](int from, int to, const Eigen::Vector3d& step) {
    for (int i = from; i < to; ++i) {
      state.add(odometryOfFrame(i, position += step));
      state.removeFrame(0);
    }
  };
  state.add(odometryOfFrame(0, position));
  fly(1, 31, {0, 0, 0.02});
  const int at = state.frameCoordinate(0);
  Information height = Information::between(at + 2, at + 3);
  height.matrix(0, 0) = 1e6;
  height.vector(0) = 1e6 * -0.1;  // the climb was shorter
  ASSERT_TRUE(state.update(height));
  EXPECT_LT(state.frames()[0].position_map.z(), 0.51);
  fly(31, 81, {0.06, 0, 0});
  const double before_m = state.frames()[0].position_map.x();
  fly(81, 91, {0.06, 0, 0});
  EXPECT_NEAR(state.frames()[0].position_map.x() - before_m, 0.6, 0.006);
}

TEST(WindowState, TheScaleIsFoundByAPositionThatIsKnown) {
  OdometryWindow state;
  constexpr double kScale = 0.02;  // reported ways are too long
  for (int i = 0; i <= 50; ++i) {
    const OdometryState odometry = odometryOfFrame(i, {(1 + kScale) * 0.2 * i, 0, 0});
    state.add(odometry);
    if (state.frames().size() > 2) state.removeFrame(0);
  }
  const double before = state.covariance()(WindowState::kScale, WindowState::kScale);
  const int at = state.frameCoordinate(state.frames().size() - 1);
  Information information = Information::between(at, at + 3);
  information.matrix = 1e4 * Eigen::Matrix3d::Identity();
  information.vector = 1e4 * (Eigen::Vector3d(10, 0, 0) - state.frames().back().position_map);
  ASSERT_TRUE(state.update(information));
  const double after = state.covariance()(WindowState::kScale, WindowState::kScale);
  EXPECT_LT(after, 0.5 * before);
  EXPECT_GT(state.scaleError(), 0.5 * kScale);
  EXPECT_LT(state.scaleError(), 1.2 * kScale);
}

TEST(WindowState, AnInflatedVelocityErrorGrowsAtOnceAndFadesLikeTheOther) {
  const OdometryNoiseConfig config;
  OdometryWindow state(config);
  state.add(odometryOfFrame(0, {0, 0, 0}));
  const double variance = config.velocity_bias_m_s * config.velocity_bias_m_s;
  state.propagator.inflate(9, state);
  for (const int at : {3, 4, 5}) EXPECT_NEAR(state.covariance()(at, at), 9 * variance, 1e-12);
  state.propagator.inflate(9, state);
  EXPECT_NEAR(state.covariance()(3, 3), 9 * variance, 1e-12) << "once";
  state.propagator.inflate(1, state);
  EXPECT_NEAR(state.covariance()(3, 3), 9 * variance, 1e-12) << "what is unknown stays unknown";
  state.add(odometryOfFrame(10'000, {0, 0, 0}));
  EXPECT_NEAR(state.covariance()(3, 3), variance, 1e-6) << "after fifty time constants";
}

TEST(WindowState, ReturnsToWhereTheOdometryAloneWouldBe) {
  OdometryWindow state = circling(10);
  while (state.frames().size() > 2) state.removeFrame(0);
  state.makeAnchor(0);
  // The bias is learned, and moves the frame.
  Information information = Information::between(WindowState::kAttitude, WindowState::kScale);
  information.matrix.diagonal().setConstant(1e5);
  information.vector.setConstant(3e3);
  ASSERT_TRUE(state.update(information));
  ASSERT_GT(state.propagator.biasSigmas(state), 0.5);
  const Eigen::Vector3d before = state.frames().back().position_map;

  Eigen::Isometry3d T_map_odom = Eigen::Isometry3d::Identity();
  T_map_odom.translation() = Eigen::Vector3d(0.5, 0, -0.2);
  T_map_odom.linear() = rotationOf({0, 0, 0.1});
  state.propagator.returnTo(T_map_odom, state);
  EXPECT_TRUE(state.propagator.T_map_odom(state).isApprox(T_map_odom, 1e-12));
  EXPECT_EQ(state.propagator.biasSigmas(state), 0);
  const Eigen::Vector3d odom(std::sin(0.9), 1 - std::cos(0.9), 0);
  EXPECT_LT((state.frames().back().position_map - T_map_odom * odom).norm(), 1e-9);
  const int at = state.frameCoordinate(0);
  const double jump_m2 = (state.frames().back().position_map - before).squaredNorm();
  EXPECT_GT((state.covariance().block<3, 3>(at, at).trace()), jump_m2);
  expectHonest(state);

  state.add(odometryOfFrame(10, {std::sin(1.0), 1 - std::cos(1.0), 0}, 1));
  EXPECT_TRUE(state.propagator.T_map_odom(state).isApprox(T_map_odom, 1e-9));
  expectHonest(state);
}

TEST(WindowState, NothingChangesWhenTheInformationIsNotFinite) {
  OdometryWindow state = circling(4);
  const Eigen::MatrixXd P = state.covariance();
  Information information =
      Information::between(state.frameCoordinate(0), state.frameCoordinate(1));
  information.vector.setConstant(std::nan(""));
  EXPECT_FALSE(state.update(information));
  EXPECT_EQ(state.covariance(), P);
}

}  // namespace
}  // namespace ardrone_vslam
