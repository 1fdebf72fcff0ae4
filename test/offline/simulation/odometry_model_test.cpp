// SPDX-License-Identifier: BSD-3-Clause
// The drift of each profile against what its numbers say analytically, over many seeds. A sample
// sigma of n draws scatters by 1 / sqrt(2 n), which is 3.5 % here; the bounds are four of that
// and more where the draws are not normal.
#include "simulation/odometry_model.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "support/shipped_profiles.hpp"
#include "support/truth_paths.hpp"
#include "support/yaw.hpp"

namespace ardrone_vslam {
namespace {

using test::circle;
using test::shippedProfile;
using test::straightLine;
using test::yawOf;

constexpr int kSeeds = 400;
constexpr double kTolerance = 0.15;
using test::kRadPerDeg;

/// Root mean squares over the seeds of three numbers that should have mean 0.
Eigen::Vector3d rms(const Trajectory& truth, const OdometryProfile& profile,
                    const std::function<Eigen::Vector3d(const OdometryRun&)>& numbers) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    sum += numbers(simulateOdometry(truth, profile, seed)).cwiseAbs2();
  }
  return (sum / kSeeds).cwiseSqrt();
}

/// Last position minus the one that is true at the end (at rest: everywhere).
std::function<Eigen::Vector3d(const OdometryRun&)> driftFrom(const Trajectory& truth) {
  const Eigen::Vector3d end = truth.poses().back().T_frame_body.translation();
  return [end](const OdometryRun& run) -> Eigen::Vector3d {
    return run.states.back().T_odom_base.translation() - end;
  };
}

double variance(double sigma) {
  return sigma * sigma;
}

/// Of the integral of OU(sigma, time constant), started stationary.
double integratedOuVariance(double sigma, double time_constant_s, double seconds) {
  const double x = seconds / time_constant_s;
  return 2 * variance(sigma * time_constant_s) * (x - 1 + std::exp(-x));
}

double pitchOf(const OdometryState& state) {
  return std::asin(-state.T_odom_base.linear()(2, 0));
}

TEST(OdometryModel, TruthIsTheInterpolatedTruthItself) {
  const Trajectory truth = circle();
  const OdometryRun run = simulateOdometry(truth, shippedProfile("truth"), 7);
  EXPECT_EQ(run.scale_error, 0);
  for (const auto& state : run.states) {
    EXPECT_EQ(state.T_odom_base.matrix(), truth.at(state.stamp_ns).matrix());
    EXPECT_EQ(state.covariance, Matrix6d::Zero());
  }
}

TEST(OdometryModel, IntegrationWithoutNoiseEqualsTheTruth) {
  const Trajectory truth = circle();
  OdometryProfile noiseless;
  noiseless.name = "noiseless";
  for (const auto& state : simulateOdometry(truth, noiseless, 7).states) {
    EXPECT_TRUE(state.T_odom_base.isApprox(truth.at(state.stamp_ns), 1e-12));
  }
}

TEST(OdometryModel, CoversTheTruthAtItsRateAndStartsAtItsPosition) {
  const Trajectory truth = circle();
  for (const auto& name : odometryProfileNames(test::kShippedProfiles)) {
    const OdometryProfile profile = shippedProfile(name);
    const auto states = simulateOdometry(truth, profile, 3).states;
    EXPECT_LE(states.front().stamp_ns, truth.poses().front().stamp_ns + 30000000) << name;
    EXPECT_GE(states.back().stamp_ns, truth.poses().back().stamp_ns) << name;
    EXPECT_LE(states.back().stamp_ns, truth.poses().back().stamp_ns + 20000000) << name;
    EXPECT_EQ(states.front().T_odom_base.translation(),
              truth.poses().front().T_frame_body.translation());
    for (const auto& state : states) {
      EXPECT_TRUE(state.T_odom_base.linear().isUnitary(1e-12));
    }
    if (profile.loss > 0) continue;
    EXPECT_EQ(states[1].stamp_ns - states[0].stamp_ns, std::llround(1e9 / profile.rate_hz));
    for (std::size_t i = 1; i < states.size(); ++i) {
      ASSERT_GT(states[i].stamp_ns, states[i - 1].stamp_ns) << name;
    }
  }
}

TEST(OdometryModel, SeedAloneDecides) {
  const Trajectory truth = circle();
  const OdometryProfile profile = shippedProfile("harsh");
  const OdometryRun a = simulateOdometry(truth, profile, 11);
  const OdometryRun b = simulateOdometry(truth, profile, 11);
  const OdometryRun other = simulateOdometry(truth, profile, 12);
  ASSERT_EQ(a.states.size(), b.states.size());
  for (std::size_t i = 0; i < a.states.size(); ++i) {
    EXPECT_EQ(a.states[i].stamp_ns, b.states[i].stamp_ns);
    EXPECT_EQ(a.states[i].T_odom_base.matrix(), b.states[i].T_odom_base.matrix());
  }
  EXPECT_NE(a.scale_error, other.scale_error);
  EXPECT_NE(a.states.back().T_odom_base.matrix(), other.states.back().T_odom_base.matrix());
}

TEST(OdometryModel, ScaleErrorIsDrawnOncePerRun) {
  OdometryProfile only_scale;
  only_scale.name = "only_scale";
  only_scale.scale_sigma = 0.03;
  const Trajectory truth = straightLine(2, 5);
  const Eigen::Vector3d scale = rms(truth, only_scale, [](const OdometryRun& run) {
    return Eigen::Vector3d::Constant(run.scale_error);
  });
  EXPECT_NEAR(scale.x(), 0.03, 0.03 * kTolerance);
  const OdometryRun run = simulateOdometry(truth, only_scale, 1);
  EXPECT_NEAR(run.states.back().T_odom_base.translation().x(), 10 * (1 + run.scale_error), 1e-9);
}

TEST(OdometryModel, WheelDriftsAsItsNumbersSay) {
  const OdometryProfile wheel = shippedProfile("wheel");
  constexpr double kLength_m = 100, kStep_m = 0.2;  // 10 m/s at 50 Hz
  const double steps = kLength_m / kStep_m;
  const Trajectory truth = straightLine(10, 10);
  const double along = variance(0.01 * kLength_m) + steps * variance(0.01 * kStep_m);
  const double across = variance(0.02 * kRadPerDeg) * std::pow(kLength_m, 3) / 3 +
                        steps * (variance(0.01 * kStep_m) + variance(0.05 * kRadPerDeg * kStep_m));
  const double height = steps * (variance(0.01 * kStep_m) + variance(0.05 * kRadPerDeg * kStep_m));
  const Eigen::Vector3d drift = rms(truth, wheel, driftFrom(truth));
  EXPECT_NEAR(drift.x() / std::sqrt(along), 1, kTolerance);
  EXPECT_NEAR(drift.y() / std::sqrt(across), 1, kTolerance);
  EXPECT_NEAR(drift.z() / std::sqrt(height), 1, kTolerance);
}

/// At rest only velocity errors move the position; their rotation by attitude errors leaves the
/// variance as it is.
void checkDriftAtRest(const std::string& name, double bias_m_s, double noise_m_s, double seconds) {
  const double expected =
      integratedOuVariance(bias_m_s, 20, seconds) + variance(noise_m_s) / 15 * seconds;
  const Trajectory truth = straightLine(0, seconds);
  const Eigen::Vector3d drift = rms(truth, shippedProfile(name), driftFrom(truth));
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(drift[axis] / std::sqrt(expected), 1, kTolerance) << name << ", axis " << axis;
  }
}

TEST(OdometryModel, DroneDriftsAtRestAsItsNumbersSay) {
  checkDriftAtRest("drone", 0.03, 0.05, 15);
}
TEST(OdometryModel, HarshDriftsAtRestAsItsNumbersSay) {
  checkDriftAtRest("harsh", 0.06, 0.1, 10);
}

TEST(OdometryModel, AnotherProfileMayTakeOver) {
  const Trajectory truth = straightLine(0, 10);
  const auto alone = simulateOdometry(truth, shippedProfile("drone"), 3);
  const auto both = simulateOdometry(truth, shippedProfile("drone,hover@5"), 3);
  EXPECT_EQ(alone.scale_error, both.scale_error);
  ASSERT_EQ(alone.states.size(), both.states.size());
  for (std::size_t i = 0; i < alone.states.size(); ++i) {
    const bool is_alike = alone.states[i].T_odom_base.isApprox(both.states[i].T_odom_base, 1e-12);
    EXPECT_EQ(is_alike, alone.states[i].stamp_ns - alone.states[0].stamp_ns < 5000000000) << i;
  }
  for (const char* wrong : {"drone,hover", "drone,hover@", "drone,hover@0", "drone,hover@3x",
                            "drone,mars@3", "drone,", "drone,hover@3,wheel@2"})
    EXPECT_THROW(shippedProfile(wrong), std::runtime_error) << wrong;
}

TEST(OdometryModel, HoverDriftsAboutTwoMetresInFifteenSeconds) {
  checkDriftAtRest("hover", 0.13, 0.05, 15);
  std::vector<double> drifts_m;
  const Trajectory truth = straightLine(0, 15);
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const auto states = simulateOdometry(truth, shippedProfile("hover"), seed).states;
    drifts_m.push_back(
        (states.back().T_odom_base.translation() - states.front().T_odom_base.translation())
            .head<2>()
            .norm());
  }
  std::nth_element(drifts_m.begin(), drifts_m.begin() + kSeeds / 2, drifts_m.end());
  EXPECT_NEAR(drifts_m[kSeeds / 2], 2.0, 0.3);
}

TEST(OdometryModel, WhiteVelocityNoiseDriftsAlikeAtEveryRate) {
  OdometryProfile noise;
  noise.name = "only_velocity_noise";
  noise.velocity_noise_m_s = 0.05;
  for (const double rate_hz : {15.0, 50.0, 200.0}) {
    noise.rate_hz = rate_hz;
    const Trajectory truth = straightLine(0, 8);
    const double drift = rms(truth, noise, driftFrom(truth)).y();
    EXPECT_NEAR(drift / (0.05 * std::sqrt(8 / 15.0)), 1, kTolerance) << rate_hz << " Hz";
  }
}

TEST(OdometryModel, AttitudeOfDroneWalksInYawAndStaysBoundedInTilt) {
  const OdometryProfile drone = shippedProfile("drone");
  const Trajectory truth = straightLine(0, 60);
  const Eigen::Vector3d error_deg = rms(truth, drone, [](const OdometryRun& run) {
    const OdometryState& last = run.states.back();
    return Eigen::Vector3d(Eigen::Vector3d(0, pitchOf(last), yawOf(last.T_odom_base)) / kRadPerDeg);
  });
  EXPECT_NEAR(error_deg.z() / std::sqrt(1 + variance(0.1)), 1, kTolerance);
  EXPECT_NEAR(error_deg.y() / std::sqrt(variance(0.3) + variance(0.1)), 1, kTolerance);
}

TEST(OdometryModel, WhiteAttitudeNoiseIsNotIntegrated) {
  OdometryProfile noise;
  noise.name = "only_attitude_noise";
  noise.attitude_noise_rad = 0.01;
  const auto states = simulateOdometry(straightLine(0, 40), noise, 1).states;
  double sum_steps = 0, sum = 0;
  for (std::size_t i = 1; i < states.size(); ++i) {
    sum += variance(yawOf(states[i].T_odom_base));
    sum_steps += variance(yawOf(states[i].T_odom_base) - yawOf(states[i - 1].T_odom_base));
  }
  const auto n = static_cast<double>(states.size());
  EXPECT_NEAR(std::sqrt(sum / n) / 0.01, 1, 0.1);
  EXPECT_NEAR(std::sqrt(sum_steps / n) / 0.01, std::sqrt(2.0), 0.1);
}

TEST(OdometryModel, VelocityBiasForgetsWithItsTimeConstant) {
  OdometryProfile bias;
  bias.name = "only_bias";
  bias.velocity_bias_m_s = 0.1;
  bias.velocity_bias_time_s = 5;
  double lagged = 0;
  constexpr int kRuns = 2000;
  const Trajectory truth = straightLine(0, 5);
  for (std::uint64_t seed = 0; seed < kRuns; ++seed) {
    const auto states = simulateOdometry(truth, bias, seed).states;
    const auto velocity = [&](std::size_t i) -> Eigen::Vector3d {
      return (states[i + 1].T_odom_base.translation() - states[i].T_odom_base.translation()) *
             bias.rate_hz;
    };
    lagged += velocity(0).dot(velocity(states.size() - 2)) / (3 * kRuns);
  }
  EXPECT_NEAR(lagged / variance(0.1), std::exp(-4.96 / 5), 0.08);
}

TEST(OdometryModel, TheStepIsIntegratedWithTheReportedAttitude) {
  OdometryProfile yaw_only;
  yaw_only.name = "only_yaw";
  yaw_only.yaw_walk_rad_per_sqrt_m = 0.05;
  const auto states = simulateOdometry(straightLine(5, 4), yaw_only, 2).states;
  for (std::size_t i = 1; i < states.size(); ++i) {
    const Eigen::Vector3d step =
        states[i - 1].T_odom_base.linear().transpose() *
        (states[i].T_odom_base.translation() - states[i - 1].T_odom_base.translation());
    EXPECT_TRUE(step.isApprox(Eigen::Vector3d(0.1, 0, 0), 1e-9));
  }
  EXPECT_GT(std::abs(yawOf(states.back().T_odom_base)), 0.01);
}

TEST(OdometryModel, TurnsAreReportedTooLargeOrTooSmallByOneShare) {
  OdometryProfile yaw_scale;
  yaw_scale.name = "only_yaw_scale";
  yaw_scale.yaw_scale_sigma = 0.02;
  const Trajectory truth = circle();
  const double rotation_rad = 0.03 * 200 * std::cos(0.1);  // about the axis of the banked body
  const double error_rad = rms(truth, yaw_scale, [&truth](const OdometryRun& run) {
                             const Eigen::Matrix3d R_true_odom =
                                 truth.poses().back().T_frame_body.linear().transpose() *
                                 run.states.back().T_odom_base.linear();
                             return Eigen::Vector3d(Eigen::AngleAxisd(R_true_odom).angle(), 0, 0);
                           }).x();
  EXPECT_NEAR(error_rad / (0.02 * rotation_rad), 1, kTolerance);
  const auto straight = simulateOdometry(straightLine(5, 4), yaw_scale, 1).states;
  EXPECT_NEAR(yawOf(straight.back().T_odom_base), 0, 1e-12) << "where nothing turns";
}

TEST(OdometryModel, HarshIsLateLosesStatesAndRepeatsStamps) {
  const Trajectory truth = straightLine(1, 60, 1000000000);
  OdometryProfile harsh = shippedProfile("harsh");
  const auto states = simulateOdometry(truth, harsh, 4).states;
  const double sent = 60 * 200 + 1;
  EXPECT_NEAR((sent - static_cast<double>(states.size())) / sent, 0.02, 0.006);
  double repeated = 0;
  std::int64_t longest_gap_ns = 0;
  for (std::size_t i = 1; i < states.size(); ++i) {
    const std::int64_t gap_ns = states[i].stamp_ns - states[i - 1].stamp_ns;
    ASSERT_GE(gap_ns, 0);
    repeated += gap_ns == 0 ? 1 : 0;
    longest_gap_ns = std::max(longest_gap_ns, gap_ns);
  }
  EXPECT_NEAR(repeated / sent, 0.5 * 5 / 6, 0.08);  // half in bursts, five of six repeat
  EXPECT_GE(longest_gap_ns, 30000000);

  // Without noise the delay is all that is left of the error: 1 m/s times 0.1 s.
  OdometryProfile late;
  late.name = "only_late";
  late.rate_hz = 200;
  late.delay_s = harsh.delay_s;
  const auto late_states = simulateOdometry(truth, late, 4).states;
  EXPECT_NEAR(late_states.back().T_odom_base.translation().x(), 60 - 0.1, 1e-9);
}

}  // namespace
}  // namespace ardrone_vslam
