// SPDX-License-Identifier: BSD-3-Clause
// Corrections at random delays on random flights.
#include "ardrone_vslam/delayed_fusion.hpp"

#include <gtest/gtest.h>

#include <deque>
#include <random>

#include "ardrone_vslam/rotation.hpp"
#include "simulation/random_source.hpp"
#include "support/eigenvalues.hpp"
#include "support/seeds.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::int64_t kPeriod_ns = 5'000'000;
constexpr int kImageEvery = 7;  // odometry messages

Eigen::Isometry3d randomPose(RandomSource& random, double size_m) {
  Eigen::Isometry3d pose(rotationOf(random.normal3()));
  pose.translation() = size_m * random.normal3();
  return pose;
}

/// A symmetric positive matrix whose axes differ by orders of magnitude.
Matrix6d randomCovariance(RandomSource& random) {
  Matrix6d root;
  for (int i = 0; i < 36; ++i) root(i) = random.normal() * std::pow(10, random.uniform(-4, 0));
  return root * root.transpose();
}

/// Odometry at 200 Hz that moves and turns at random.
std::vector<OdometryState> randomFlight(RandomSource& random, int count) {
  std::vector<OdometryState> flight;
  OdometryState state;
  state.stamp_ns = 1'000'000'000;
  state.T_odom_base = randomPose(random, 10);
  const bool gives_covariance = random.chance(0.5);
  for (int i = 0; i < count; ++i) {
    state.stamp_ns += kPeriod_ns;
    Eigen::Isometry3d step(rotationOf(0.01 * random.normal3()));
    step.translation() = 0.02 * random.normal3();
    state.T_odom_base = state.T_odom_base * step;
    if (gives_covariance) state.covariance += 1e-4 * randomCovariance(random);
    state.twist_base.setConstant(random.normal());
    flight.push_back(state);
  }
  return flight;
}

LateCorrection correctionOf(const OdometryState& state, const Eigen::Isometry3d& T_map_odom,
                            RandomSource& random) {
  LateCorrection correction;
  correction.stamp_ns = state.stamp_ns;
  correction.T_odom_base = state.T_odom_base;
  correction.T_map_base = T_map_odom * state.T_odom_base;
  correction.covariance = randomCovariance(random);
  return correction;
}

struct InFlight {
  std::size_t arrives_at;
  LateCorrection correction;
};

TEST(DelayedFusionProperty, OutputIsTheRawOdometrySeenThroughTheNewestCorrectionHoweverLate) {
  for (const std::uint64_t seed : test::seeds()) {
    RandomSource random(seed);
    const auto flight = randomFlight(random, 1500);
    DelayedFusion fusion({});
    std::deque<InFlight> under_way;
    Eigen::Isometry3d T_map_odom = Eigen::Isometry3d::Identity();  // of the newest that has arrived
    int used = 0;
    for (std::size_t i = 0; i < flight.size(); ++i) {
      ASSERT_EQ(fusion.push(flight[i]), OdometryBuffer::Push::kAccepted);
      if (i % kImageEvery == 0) {
        const std::size_t previous = under_way.empty() ? i : under_way.back().arrives_at;
        const auto delay = static_cast<std::size_t>(random.integer(0, 100));
        under_way.push_back({std::max(previous, i + delay),
                             correctionOf(flight[i], randomPose(random, 1), random)});
      }
      while (!under_way.empty() && under_way.front().arrives_at <= i) {
        const LateCorrection c = under_way.front().correction;
        ASSERT_EQ(fusion.correct(c), DelayedFusion::Answer::kUsed) << seed << ' ' << i;
        T_map_odom = c.T_map_base * c.T_odom_base.inverse();
        ++used;
        under_way.pop_front();
        // Re-propagated: every state since the stamp, each exactly the raw one seen from map.
        const auto states = fusion.sinceCorrection();
        const auto first = static_cast<std::size_t>((c.stamp_ns - flight[0].stamp_ns) / kPeriod_ns);
        ASSERT_EQ(states.size(), i + 1 - first);
        for (std::size_t k = 0; k < states.size(); ++k) {
          const OdometryState& raw = flight[first + k];
          ASSERT_EQ(states[k].stamp_ns, raw.stamp_ns);
          ASSERT_TRUE(states[k].T_map_base.isApprox(T_map_odom * raw.T_odom_base, 1e-12));
        }
        // At the stamp itself it is the fused pose.
        ASSERT_TRUE(states.front().T_map_base.isApprox(c.T_map_base, 1e-9));
      }
      const auto newest = fusion.newest();
      ASSERT_EQ(newest.has_value(), used > 0);
      if (!newest) continue;
      ASSERT_EQ(newest->stamp_ns, flight[i].stamp_ns);
      ASSERT_TRUE(newest->T_map_base.isApprox(T_map_odom * flight[i].T_odom_base, 1e-12));
      ASSERT_EQ(newest->twist_base, flight[i].twist_base);
    }
    EXPECT_GT(used, 150);
  }
}

TEST(DelayedFusionProperty, AnExactCorrectionMakesAllSinceExactHoweverLate) {
  for (const std::uint64_t seed : test::seeds()) {
    RandomSource random(seed);
    for (int run = 0; run < 20; ++run) {
      const auto flight = randomFlight(random, 300);
      // The odometry's frame has drifted; since the image it has not.
      const Eigen::Isometry3d T_map_odom = randomPose(random, 5);
      DelayedFusion fusion({});
      for (const auto& state : flight) fusion.push(state);
      const auto image = static_cast<std::size_t>(random.integer(0, 298));
      OdometryState between =
          interpolate(flight[image], flight[image + 1],
                      flight[image].stamp_ns + random.integer(0, static_cast<int>(kPeriod_ns)));
      ASSERT_EQ(fusion.correct(correctionOf(between, T_map_odom, random)),
                DelayedFusion::Answer::kUsed);
      for (const auto& state : fusion.sinceCorrection()) {
        const auto i = static_cast<std::size_t>((state.stamp_ns - flight[0].stamp_ns) / kPeriod_ns);
        const Eigen::Isometry3d truth = T_map_odom * flight[i].T_odom_base;
        ASSERT_LT((state.T_map_base.translation() - truth.translation()).norm(), 1e-10);
        ASSERT_TRUE(state.T_map_base.linear().isApprox(truth.linear(), 1e-12));
      }
    }
  }
}

TEST(DelayedFusionProperty, CovarianceIsSymmetricAndPositiveAndTheAttitudesGrows) {
  for (const std::uint64_t seed : test::seeds()) {
    RandomSource random(seed);
    for (int run = 0; run < 20; ++run) {
      const auto flight = randomFlight(random, 300);
      DelayedFusion fusion({});
      for (int i = 0; i < 50; ++i) fusion.push(flight[static_cast<std::size_t>(i)]);
      const LateCorrection correction = correctionOf(flight[20], randomPose(random, 5), random);
      ASSERT_EQ(faultOf(correction), "");
      ASSERT_EQ(fusion.correct(correction), DelayedFusion::Answer::kUsed);
      for (std::size_t i = 50; i < flight.size(); ++i) {
        fusion.push(flight[i]);
        const Matrix6d P = fusion.newest()->covariance;
        ASSERT_TRUE(P.allFinite());
        ASSERT_EQ(P, Matrix6d(P.transpose()));
        const Eigen::VectorXd eigenvalues = test::eigenvaluesOf(P);
        ASSERT_GT(eigenvalues[0], -1e-12 * eigenvalues.maxCoeff());
        ASSERT_TRUE((P.diagonal().tail<3>().array() >=
                     correction.covariance.diagonal().tail<3>().array() * (1 - 1e-12))
                        .all());
      }
    }
  }
}

/// The lever arm's Jacobian against the poses themselves: an error of the fused pose, put into the
/// correction, moves the newest pose as the covariance of that error alone says.
TEST(DelayedFusionProperty, CovarianceFollowsAnErrorOfTheCorrection) {
  constexpr double kStep = 1e-6;
  DelayedFusionConfig config;
  config.walk_m_per_sqrt_m = config.walk_m_per_sqrt_s = config.velocity_bias_m_s = 0;
  config.scale_sigma = 1e-6;  // the least
  config.tilt_sigma_deg = 0;
  config.yaw_walk_deg_per_sqrt_s = config.yaw_walk_deg_per_sqrt_m = 0;
  for (const std::uint64_t seed : test::seeds()) {
    RandomSource random(seed);
    auto flight = randomFlight(random, 100);
    for (auto& state : flight) state.covariance.setZero();
    LateCorrection correction = correctionOf(flight[10], randomPose(random, 5), random);
    const auto newestWith = [&](const LateCorrection& c) {
      DelayedFusion fusion(config);
      for (const auto& state : flight) fusion.push(state);
      EXPECT_EQ(fusion.correct(c), DelayedFusion::Answer::kUsed);
      return *fusion.newest();
    };
    const MapState before = newestWith(correction);
    Matrix6d J;
    for (int axis = 0; axis < 6; ++axis) {
      Vector6d error = Vector6d::Zero();
      error[axis] = kStep;
      LateCorrection moved = correction;
      moved.T_map_base.translation() += error.head<3>();
      moved.T_map_base.linear() = rotationOf(error.tail<3>()) * moved.T_map_base.linear();
      const MapState after = newestWith(moved);
      J.col(axis).head<3>() =
          (after.T_map_base.translation() - before.T_map_base.translation()) / kStep;
      J.col(axis).tail<3>() =
          rotationVectorOf(after.T_map_base.linear() * before.T_map_base.linear().transpose()) /
          kStep;
    }
    const Matrix6d expected = J * correction.covariance * J.transpose();
    EXPECT_TRUE(before.covariance.isApprox(expected, 1e-4)) << seed;
  }
}

}  // namespace
}  // namespace ardrone_vslam
