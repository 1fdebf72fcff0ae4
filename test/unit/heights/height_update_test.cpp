// SPDX-License-Identifier: BSD-3-Clause
#include "heights/height_update.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "support/odometry_states.hpp"
#include "support/odometry_window.hpp"

namespace ardrone_vslam {
namespace {

/// One frame a second, climbing by `climb_m` each; all stay.
class Climb {
 public:
  explicit Climb(double climb_m) : climb_m_(climb_m) { addFrame(); }
  void step() {
    ++frame_;
    addFrame();
  }
  int newestZ() const { return state_.frameCoordinate(state_.frames().size() - 1) + 2; }
  double reported_m() const { return climb_m_ * frame_; }
  WindowState& state() { return state_; }

 private:
  void addFrame() {
    state_.add(test::odometryAt(1'000'000'000LL * (frame_ + 1), {0.1 * frame_, 0, reported_m()}));
  }

  double climb_m_;
  int frame_ = 0;
  OdometryWindow state_;
};

HeightConfig often() {
  HeightConfig config;
  config.height_interval_s = 0;
  return config;
}

TEST(HeightUpdate, TheFirstHeightTellsWhereTheFloorIsAndNothingElse) {
  Climb climb(0.2);
  climb.step();
  const Eigen::MatrixXd P = climb.state().covariance();
  HeightUpdate heights(often());
  EXPECT_EQ(heights.apply(1.5, climb.state()), HeightOutcome::kNewFloor);
  EXPECT_NEAR(climb.state().floor_map_m(), 0.2 - 1.5, 1e-12);
  const Eigen::MatrixXd& now = climb.state().covariance();
  constexpr int kFloor = WindowState::kFloor;
  const int z = climb.newestZ();
  EXPECT_NEAR(now(kFloor, kFloor), P(z, z) + 0.03 * 0.03, 1e-12);
  EXPECT_NEAR(now(kFloor, WindowState::kScale), P(z, WindowState::kScale), 1e-12);
  EXPECT_NEAR(now(kFloor, z), P(z, z), 1e-12);
  EXPECT_EQ(now(z, z), P(z, z));
  EXPECT_EQ(now(WindowState::kScale, WindowState::kScale),
            P(WindowState::kScale, WindowState::kScale));
}

TEST(HeightUpdate, ALaterHeightIsTheKalmanUpdateOfItsDifferenceFromTheFirst) {
  Climb climb(0.3);
  HeightUpdate heights(often());
  heights.apply(1, climb.state());
  climb.step();
  const Eigen::MatrixXd P = climb.state().covariance();
  Eigen::RowVectorXd H = Eigen::RowVectorXd::Zero(P.rows());
  H(climb.newestZ()) = 1;
  H(WindowState::kFloor) = -1;
  const double variance_m2 = (H * P * H.transpose()).value() + 0.03 * 0.03;
  constexpr double kInnovation_m = 0.02;
  const Eigen::VectorXd error = P * H.transpose() * kInnovation_m / variance_m2;
  EXPECT_EQ(heights.apply(1.3 + kInnovation_m, climb.state()), HeightOutcome::kApplied);
  EXPECT_NEAR(climb.state().frames().back().position_map.z(), 0.3 + error(climb.newestZ()), 1e-9);
  EXPECT_NEAR(climb.state().floor_map_m(), -1 + error(WindowState::kFloor), 1e-9);
  EXPECT_NEAR(climb.state().scaleError(), error(WindowState::kScale), 1e-9);
  EXPECT_LT(climb.state().scaleError(), 0) << "it climbed by more than the odometry says";
}

TEST(HeightUpdate, NeighboursAreNotUsed) {
  HeightConfig config;
  config.height_interval_s = 2;
  Climb climb(0);
  HeightUpdate heights(config);
  EXPECT_EQ(heights.apply(1, climb.state()), HeightOutcome::kNewFloor);
  climb.step();
  EXPECT_EQ(heights.apply(1, climb.state()), HeightOutcome::kNone);
  climb.step();
  EXPECT_EQ(heights.apply(1, climb.state()), HeightOutcome::kApplied);
}

TEST(HeightUpdate, AStepIsRejectedAndANewFloorOnceItLasts) {
  HeightConfig config = often();
  config.floor_step_s = 2;
  Climb climb(0);
  HeightUpdate heights(config);
  heights.apply(2, climb.state());
  const double floor_m = climb.state().floor_map_m();
  const auto next = [&](double height_m) {
    climb.step();
    return heights.apply(height_m, climb.state());
  };
  EXPECT_EQ(next(1), HeightOutcome::kRejected);
  EXPECT_EQ(next(2), HeightOutcome::kApplied) << "it was an outlier";
  EXPECT_EQ(next(1), HeightOutcome::kRejected);
  EXPECT_EQ(next(0.5), HeightOutcome::kRejected) << "begins anew: it does not agree";
  EXPECT_EQ(next(0.5), HeightOutcome::kRejected);
  EXPECT_NEAR(climb.state().floor_map_m(), floor_m, 0.02);
  EXPECT_EQ(next(0.5), HeightOutcome::kNewFloor);
  EXPECT_NEAR(climb.state().floor_map_m(), climb.state().frames().back().position_map.z() - 0.5,
              1e-12);
  EXPECT_EQ(next(0.5), HeightOutcome::kApplied);
}

TEST(HeightUpdate, ItsParametersAreChecked) {
  HeightConfig config;
  config.height_sigma_m = 0;
  EXPECT_THROW(HeightUpdate{config}, ConfigError);
}

}  // namespace
}  // namespace ardrone_vslam
