// SPDX-License-Identifier: BSD-3-Clause
// The textbook's correction, in single precision and in doubles.
#include "window/correction.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "ardrone_vslam/rotation.hpp"
#include "simulation/random_source.hpp"
#include "support/eigenvalues.hpp"
#include "support/odometry_states.hpp"
#include "support/odometry_window.hpp"

namespace ardrone_vslam {
namespace {

using test::odometryOfFrame;

/// P (I + N P)^-1.
Eigen::MatrixXd updatedInLongDoubles(const Eigen::MatrixXd& P, const Information& information) {
  using Matrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
  const Matrix prior = P.cast<long double>();
  const int first = information.coordinates.front();
  Matrix N = Matrix::Zero(P.rows(), P.cols());
  N.block(first, first, information.size(), information.size()) =
      information.matrix.cast<long double>();
  const Matrix I = Matrix::Identity(P.rows(), P.cols());
  return (I + prior * N).fullPivLu().solve(prior).cast<double>();
}

TEST(Correction, AnUpdateIsTheKalmanUpdateInCoordinatesThatItDoesNotTurn) {
  // Of the attitude of a frame whose position does not depend on it: nothing is stretched, so that
  // the textbook's formula holds.
  for (const bool is_large : {false, true}) {
    OdometryNoiseConfig config;
    if (is_large) config.attitude_noise_deg = 20;
    OdometryWindow state(config);
    state.add(odometryOfFrame(0, {0, 0, 0}));
    const Eigen::MatrixXd P = state.covariance();
    const int at = state.frameCoordinate(0) + 3;
    Information information = Information::between(at, at + 3);
    constexpr double kVariance = 1e-6;
    const Eigen::Vector3d innovation(0.001, -0.002, 0.0005);
    information.matrix = Eigen::Matrix3d::Identity() / kVariance;
    information.vector = innovation / kVariance;
    const Eigen::Matrix3d before = state.frames()[0].R_map_rig;
    ASSERT_TRUE(state.update(information));
    Eigen::MatrixXd H = Eigen::MatrixXd::Zero(3, P.rows());
    H.middleCols<3>(at).setIdentity();
    const Eigen::Matrix3d S = H * P * H.transpose() + kVariance * Eigen::Matrix3d::Identity();
    const Eigen::MatrixXd K = P * H.transpose() * S.inverse();
    EXPECT_LT((state.covariance() - (P - K * H * P)).cwiseAbs().maxCoeff(),
              is_large ? 1e-12 : 4e-6 * P(at, at));
    EXPECT_LT((rotationVectorOf(state.frames()[0].R_map_rig * before.transpose()) -
               (K * innovation).segment<3>(at))
                  .norm(),
              1e-9);
  }
}

/// A window whose poses share a drift and know each other to millimetres.
OdometryWindow windowBehindDrift(double variance_m2) {
  OdometryWindow state;
  OdometryState odometry = odometryOfFrame(0, {0, 0, 0});
  odometry.covariance.diagonal().setConstant(1e-3);
  state.add(odometry);
  for (int i = 1; i < 14; ++i) {
    const double turn = 0.1 * i;
    odometry = odometryOfFrame(i, {std::sin(turn), 1 - std::cos(turn), 0}, turn);
    odometry.covariance.diagonal() << variance_m2, variance_m2, variance_m2, 0.01, 0.01, 0.01;
    state.add(odometry);
  }
  state.removeFrame(0);
  return state;
}

/// What tracks say: places of the frames relative to each other, with a deviation of a millimetre.
Information relativeInformation(const WindowState& state) {
  Information information =
      Information::between(state.frameCoordinate(0), state.frameCoordinate(state.frames().size()));
  RandomSource random(5);
  for (int row = 0; row < 60; ++row) {
    Eigen::VectorXd h(information.size());
    for (Eigen::Index k = 0; k < h.size(); ++k) h(k) = 1000 * random.normal();
    for (int axis = 0; axis < 3; ++axis) {
      double sum = 0;
      for (Eigen::Index k = axis; k < h.size(); k += WindowState::kFrame) sum += h(k);
      h(axis) -= sum;
    }
    information.matrix += h * h.transpose();
  }
  return information;
}

Information driftInformation(const WindowState& state, double deviation_m) {
  const int at = state.frameCoordinate(0);
  Information information = Information::between(at, at + 3);
  information.matrix.diagonal().setConstant(1 / (deviation_m * deviation_m));
  return information;
}

/// The largest share by which covariances of frames relative to the newest one differ.
double largestChange(const WindowState& state, const Eigen::MatrixXd& expected) {
  const int newest = state.frameCoordinate(state.frames().size() - 1);
  double largest = 0;
  for (int at = state.frameCoordinate(0); at < newest; at += WindowState::kFrame) {
    const auto apart = [&](const auto& P) {
      return (P.template block<3, 3>(at, at) + P.template block<3, 3>(newest, newest) -
              P.template block<3, 3>(at, newest) - P.template block<3, 3>(newest, at))
          .trace();
    };
    largest = std::max(largest, std::abs(apart(state.covariance()) / apart(expected) - 1));
  }
  return largest;
}

void expectPositive(const WindowState& state) {
  const Eigen::MatrixXd P = state.covariance();
  EXPECT_EQ(P, P.transpose());
  EXPECT_GT(test::leastEigenvalue(P), -1e-12);
}

// In single precision, as the common drift is taken apart: else doubles would be needed.
TEST(Correction, WhatPosesMeasureOfEachOtherIsNotLostBehindALongDrift) {
  OdometryWindow state = windowBehindDrift(6e3);
  const Information information = relativeInformation(state);
  const Eigen::MatrixXd before = state.covariance();
  ASSERT_TRUE(state.update(information));
  EXPECT_GT(largestChange(state, before), 0.99);
  const double change = largestChange(state, updatedInLongDoubles(before, information));
  EXPECT_LT(change, 2e-3);  // measured: 1.3e-3, what is added for rounding
  EXPECT_GT(change, 1e-5) << "nothing was added: it was in doubles";
  expectPositive(state);
}

// In doubles.
TEST(Correction, ALongDriftThatIsTakenAtOnceLeavesWhatPosesKnowOfEachOther) {
  OdometryWindow state = windowBehindDrift(6e3);
  ASSERT_TRUE(state.update(relativeInformation(state)));
  const Information information = driftInformation(state, 0.01);
  const Eigen::MatrixXd before = state.covariance();
  ASSERT_TRUE(state.update(information));
  const Eigen::MatrixXd expected = updatedInLongDoubles(before, information);
  EXPECT_LT(largestChange(state, expected), 1e-6);
  EXPECT_LT((state.covariance() - expected).cwiseAbs().maxCoeff(), 1e-9);
  expectPositive(state);
}

// The most that single precision takes: what it rounds is more than what is left.
TEST(Correction, ASmallDriftThatIsTakenAtOnceLeavesThePosesPositive) {
  OdometryWindow state = windowBehindDrift(0.015);
  ASSERT_TRUE(state.update(relativeInformation(state)));
  const Information information = driftInformation(state, 1e-6);
  const Eigen::MatrixXd before = state.covariance();
  ASSERT_TRUE(state.update(information));
  const Eigen::MatrixXd expected = updatedInLongDoubles(before, information);
  EXPECT_LT(largestChange(state, expected), 0.02);  // measured: 0.012, of 1e-6 m^2
  expectPositive(state);
}

}  // namespace
}  // namespace ardrone_vslam
