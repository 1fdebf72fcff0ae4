// SPDX-License-Identifier: BSD-3-Clause
// How Propagator::propagate carries errors on, against differences of the poses themselves.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <limits>

#include "ardrone_vslam/rotation.hpp"
#include "linear/selection.hpp"
#include "support/odometry_states.hpp"
#include "support/odometry_window.hpp"

namespace ardrone_vslam {
namespace {

constexpr int kClimbFrames = 8;

/// Of a climb in a left turn, tilted.
OdometryState climbingTurnAt(int frame) {
  OdometryState state = test::odometryOfFrame(frame, {0.1 * frame, 0.03 * frame, 0.02 * frame});
  state.T_odom_base.linear() = rotationOf({0.03 * frame, -0.02 * frame, 0.08 * frame});
  return state;
}

/// All but the floor's, which is exactly known as long as nobody measures a height.
std::vector<int> uncertainCoordinates(const WindowState& state) {
  std::vector<int> coordinates;
  for (int k = 0; k < state.frameCoordinate(state.frames().size()); ++k)
    if (k != WindowState::kFloor) coordinates.push_back(k);
  return coordinates;
}

/// Makes a measurement that moves the mean by the change (of the uncertain coordinates). It takes
/// so much of the scale's variance that the correction is made in doubles.
void moveMean(WindowState& state, const Eigen::VectorXd& change) {
  Information information(uncertainCoordinates(state));
  const Eigen::MatrixXd P =
      rowsOf(colsOf(state.covariance(), information.coordinates), information.coordinates);
  information.matrix.diagonal().setConstant(1e-3);
  information.matrix(WindowState::kScale, WindowState::kScale) = 0.1;
  information.vector = P.llt().solve(change) + information.matrix * change;
  const auto preview = state.preview(information);
  ASSERT_TRUE(preview);
  ASSERT_LT((*preview - change).norm(), 1e-6 * change.norm());  // in single precision
  ASSERT_TRUE(state.update(information));
}

/// A window whose odom and mounting were found to be turned. Neither bias nor scale have been
/// corrected: else F stands by the corrected step for the reported one.
OdometryWindow window(OdometryNoiseConfig config, const Eigen::Vector3d& odom_rotation_rad) {
  config.scale_sigma = 1;
  OdometryWindow state(config);
  state.add(climbingTurnAt(0));
  for (int i = 1; i < kClimbFrames; ++i) state.add(climbingTurnAt(i));
  Eigen::VectorXd change =
      Eigen::VectorXd::Zero(static_cast<Eigen::Index>(uncertainCoordinates(state).size()));
  change.segment<3>(WindowState::kAttitude) = odom_rotation_rad;
  change.segment<3>(WindowState::kExtrinsics) << 0.05, -0.1, 0.15;
  moveMean(state, change);
  return state;
}

/// What the next step makes of the mean: attitude of odom, mounting, newest position and attitude.
constexpr int kOutputs = 12;

Eigen::Matrix<double, kOutputs, 1> difference(const OdometryWindow& a, const OdometryWindow& b) {
  Eigen::Matrix<double, kOutputs, 1> d;
  const Clone& pose_a = a.frames().back();
  const Clone& pose_b = b.frames().back();
  d << rotationVectorOf(a.propagator.T_map_odom(a).linear() *
                        b.propagator.T_map_odom(b).linear().transpose()),
      rotationVectorOf(a.R_base_rig() * b.R_base_rig().transpose()),
      pose_a.position_map - pose_b.position_map,
      rotationVectorOf(pose_a.R_map_rig * pose_b.R_map_rig.transpose());
  return d;
}

/// By central differences of the mean, one coordinate after the other.
void expectErrorsCarriedAsTheMeanIs(const OdometryWindow& before) {
  const std::vector<int> inputs = uncertainCoordinates(before);
  const auto size = static_cast<Eigen::Index>(inputs.size());
  constexpr double kStep = 1e-5;
  Eigen::MatrixXd transition(kOutputs, size);
  for (Eigen::Index k = 0; k < size; ++k) {
    OdometryWindow more = before;
    OdometryWindow less = before;
    moveMean(more, kStep * Eigen::VectorXd::Unit(size, k));
    moveMean(less, -kStep * Eigen::VectorXd::Unit(size, k));
    more.add(climbingTurnAt(kClimbFrames));
    less.add(climbingTurnAt(kClimbFrames));
    transition.col(k) = difference(more, less) / (2 * kStep);
  }
  OdometryWindow after = before;
  after.add(climbingTurnAt(kClimbFrames));
  // Of the errors that a step leaves alone, which take no noise: their covariance with the new ones
  // is the transition times what it was.
  std::vector<int> kept;
  for (int k = before.frameCoordinate(0); k < before.frameCoordinate(kClimbFrames); ++k)
    kept.push_back(k);
  std::vector<int> outputs;
  const int newest = before.frameCoordinate(kClimbFrames);
  for (const int first : {static_cast<int>(WindowState::kAttitude),
                          static_cast<int>(WindowState::kExtrinsics), newest, newest + 3})
    for (int k = 0; k < 3; ++k) outputs.push_back(first + k);
  const Eigen::MatrixXd expected = transition * rowsOf(colsOf(before.covariance(), kept), inputs);
  const Eigen::MatrixXd actual = rowsOf(colsOf(after.covariance(), kept), outputs);
  const char* const kNames[] = {"attitude of odom", "mounting", "position", "attitude"};
  for (Eigen::Index k = 0; k < kOutputs; ++k) {
    ASSERT_GT(expected.row(k).norm(), 1e-6);
    EXPECT_LT((actual - expected).row(k).norm(), 1e-6 * expected.row(k).norm())
        << kNames[k / 3] << " " << k % 3;
  }
}

TEST(WindowPropagation, CarriesErrorsAsSmallChangesOfTheMeanShow) {
  OdometryNoiseConfig config;
  config.extrinsics_sigma_deg = 2;
  config.tilt_time_s = 1e6;
  expectErrorsCarriedAsTheMeanIs(window(config, {0.2, -0.1, 0.4}));
}

/// To first order in the turn of odom, which is a few degrees.
TEST(WindowPropagation, CarriesErrorsOfATiltThatFades) {
  OdometryNoiseConfig config;
  config.extrinsics_sigma_deg = 2;
  config.tilt_time_s = 0.5;
  expectErrorsCarriedAsTheMeanIs(window(config, {0, 0, 0}));
}

TEST(Propagator, AHoleCountsAsASecondOfWhatWasKnownBefore) {
  const auto levelAfter = [](double hole_s) {
    OdometryWindow state;
    state.add(climbingTurnAt(0));
    Information found({WindowState::kBias, WindowState::kBias + 1, WindowState::kBias + 2});
    found.matrix.diagonal().setConstant(1e6);  // there is no bias
    EXPECT_TRUE(state.update(found));
    OdometryState next = climbingTurnAt(0);
    next.stamp_ns += static_cast<std::int64_t>(hole_s * 1e9);
    state.propagator.learnVelocityBias(next, state);
    return state.propagator.learned().bias.sigma_m_s();
  };
  EXPECT_LT(levelAfter(1), levelAfter(0.5));
  EXPECT_EQ(levelAfter(30), levelAfter(1));
}

TEST(Propagator, AFactorThatComesAndGoesIsNotLearned) {
  OdometryWindow state;
  state.add(climbingTurnAt(0));
  const double configured_m_s = state.propagator.learned().bias.sigma_m_s();
  for (int i = 1; i < 2000; ++i) {
    if (i % 50 == 0) state.propagator.inflate(i % 100 == 0 ? 1 : 4, state);
    state.propagator.learnVelocityBias(climbingTurnAt(i), state);
    state.add(climbingTurnAt(i));
    state.removeFrame(0);
  }
  EXPECT_NEAR(state.propagator.learned().bias.sigma_m_s(), configured_m_s, 1e-9);
}

TEST(Propagator, FrameIdsComeRoundPastNoneAndThoseInUse) {
  constexpr std::uint32_t kLargest = std::numeric_limits<std::uint32_t>::max();
  OdometryWindow state({}, kLargest);
  state.add(climbingTurnAt(0));
  for (int i = 1; i < 4; ++i) state.add(climbingTurnAt(i));
  state.makeAnchor(0);
  std::vector<std::uint32_t> ids;
  for (const Clone& frame : state.frames()) ids.push_back(frame.id);
  EXPECT_EQ(ids, (std::vector<std::uint32_t>{1, 2, 3})) << "0 is no frame";
  ASSERT_EQ(state.anchors()[0].id, kLargest);

  // The other one begins where its anchor has its id.
  OdometryWindow again({}, kLargest - 1);
  again.add(climbingTurnAt(0));
  again.propagator = Propagator({}, FrameIds(kLargest - 1));
  again.propagator.propagate(climbingTurnAt(1), std::nullopt, again);
  EXPECT_EQ(again.frames().back().id, kLargest);
}

}  // namespace
}  // namespace ardrone_vslam
