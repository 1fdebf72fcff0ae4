// SPDX-License-Identifier: BSD-3-Clause
// Laws that hold for every world: moving it moves the poses alike, equal input gives equal bytes.
#include <gtest/gtest.h>

#include <cstring>

#include "support/eigenvalues.hpp"
#include "support/point_flight.hpp"

namespace ardrone_vslam {
namespace {

using test::FlightRun;

struct Recording {
  std::vector<ImageFeatures> frames;
  std::vector<OdometryState> odometry;
};

Recording recordLaps(std::uint64_t seed) {
  test::ViewFaults faults;
  faults.wrong_share = 0.1;
  test::PointWorld world(seed, faults);
  world.addRoom({10, 8, 3}, 800);
  const test::Flight flight = test::lapsFlight(100, 2, 10);
  return {test::film(world, flight), test::observe(flight, {}, seed)};
}

std::vector<OdometryState> moved(std::vector<OdometryState> states,
                                 const Eigen::Isometry3d& T_new_old) {
  for (OdometryState& state : states) state.T_odom_base = T_new_old * state.T_odom_base;
  return states;
}

class SlamProperty : public ::testing::TestWithParam<MeanKind> {
 protected:
  SlamConfig config() const {
    SlamConfig config = test::thesisConfig();
    config.thesis_filter.mean = GetParam();
    return config;
  }

  /// Runs the same images with a moved odometry frame and compares.
  void expectMovesAlike(const SlamConfig& config, const Eigen::Isometry3d& T_new_old) {
    const Recording recording = recordLaps(3);
    const FlightRun still = test::run(recording.frames, recording.odometry, config);
    const FlightRun turned =
        test::run(recording.frames, moved(recording.odometry, T_new_old), config);
    const Eigen::Matrix3d R = T_new_old.linear();
    constexpr double kRounding = 1e-9;
    int localised = 0;
    for (std::size_t i = 0; i < still.results.size(); ++i) {
      const FrameResult& a = still.results[i];
      const FrameResult& b = turned.results[i];
      ASSERT_EQ(a.state, b.state) << i;
      ASSERT_EQ(a.landmark_matches, b.landmark_matches) << i;
      ASSERT_EQ(a.landmarks, b.landmarks) << i;
      const Eigen::Isometry3d expected = T_new_old * a.T_map_base;
      ASSERT_LT((expected.matrix() - b.T_map_base.matrix()).cwiseAbs().maxCoeff(), kRounding) << i;
      const Eigen::Matrix3d covariance = R * a.covariance.topLeftCorner<3, 3>() * R.transpose();
      ASSERT_LT((covariance - b.covariance.topLeftCorner<3, 3>()).cwiseAbs().maxCoeff(), kRounding)
          << i;
      localised += a.state == SlamState::kLocalised ? 1 : 0;
    }
    EXPECT_GT(localised, 100) << "nothing was compared";
    ASSERT_EQ(still.landmarks.size(), turned.landmarks.size());
    for (std::size_t i = 0; i < still.landmarks.size(); ++i) {
      const Eigen::Vector3d expected = T_new_old * still.landmarks[i].position_map;
      ASSERT_LT((expected - turned.landmarks[i].position_map).norm(), 1e-7) << i;
    }
  }
};

TEST_P(SlamProperty, TranslationOfTheOdometryMovesThePosesAlike) {
  expectMovesAlike(config(), Eigen::Isometry3d(Eigen::Translation3d(3, -7, 2)));
}

TEST_P(SlamProperty, YawOfTheOdometryTurnsThePosesAlike) {
  expectMovesAlike(config(), Eigen::Translation3d(-1, 4, 0.5) *
                                 Eigen::AngleAxisd(2.1, Eigen::Vector3d::UnitZ()));
}

TEST_P(SlamProperty, AnyTurnOfTheOdometryTurnsThePosesAlike) {
  expectMovesAlike(config(), Eigen::Translation3d(1, 2, 3) *
                                 Eigen::AngleAxisd(1.2, Eigen::Vector3d(1, -2, 0.5).normalized()));
}

TEST_P(SlamProperty, PlanarModeTurnsAboutTheVertical) {
  SlamConfig planar = config();
  planar.planar = true;
  expectMovesAlike(
      planar, Eigen::Translation3d(-1, 4, 0) * Eigen::AngleAxisd(-0.8, Eigen::Vector3d::UnitZ()));
}

TEST_P(SlamProperty, EqualInputGivesEqualBytes) {
  const Recording recording = recordLaps(4);
  const FlightRun first = test::run(recording.frames, recording.odometry, config());
  const FlightRun second = test::run(recording.frames, recording.odometry, config());
  const auto bytesEqual = [](const auto& a, const auto& b) {
    return std::memcmp(a.data(), b.data(), sizeof(double) * static_cast<std::size_t>(a.size())) ==
           0;
  };
  ASSERT_EQ(first.results.size(), second.results.size());
  for (std::size_t i = 0; i < first.results.size(); ++i) {
    ASSERT_TRUE(
        bytesEqual(first.results[i].T_map_base.matrix(), second.results[i].T_map_base.matrix()));
    ASSERT_TRUE(bytesEqual(first.results[i].covariance, second.results[i].covariance));
  }
  ASSERT_EQ(first.landmarks.size(), second.landmarks.size());
  for (std::size_t i = 0; i < first.landmarks.size(); ++i) {
    ASSERT_EQ(first.landmarks[i].id, second.landmarks[i].id);
    ASSERT_TRUE(bytesEqual(first.landmarks[i].position_map, second.landmarks[i].position_map));
  }
}

TEST_P(SlamProperty, OutputIsFiniteAndTheCovariancePositiveDefinite) {
  for (const bool common_drift : {true, false}) {
    SlamConfig with = config();
    with.thesis_filter.common_drift = common_drift;
    const Recording recording = recordLaps(5);
    for (const FrameResult& r : test::run(recording.frames, recording.odometry, with).results) {
      ASSERT_TRUE(r.T_map_base.matrix().allFinite());
      const Eigen::Matrix3d p = r.covariance.topLeftCorner<3, 3>();
      ASSERT_EQ(p, Eigen::Matrix3d(p.transpose()));
      ASSERT_GT(test::leastEigenvalue(p), 0);
      ASSERT_NEAR(r.sigma_m, std::sqrt(p.trace() / 3), 1e-12);
    }
  }
}

TEST_P(SlamProperty, OrientationIsTheOdometrys) {
  const Recording recording = recordLaps(6);
  const FlightRun run = test::run(recording.frames, recording.odometry, config());
  for (std::size_t i = 0; i < run.results.size(); ++i) {
    ASSERT_EQ(run.results[i].T_map_base.linear(), recording.odometry[i].T_odom_base.linear());
    ASSERT_EQ(run.results[i].T_odom_base.matrix(), recording.odometry[i].T_odom_base.matrix());
  }
}

INSTANTIATE_TEST_SUITE_P(Means, SlamProperty,
                         ::testing::Values(MeanKind::kPrinted, MeanKind::kExact),
                         [](const auto& mean) { return std::string(nameOf(mean.param)); });

TEST(MsckfProperty, EveryCovarianceIsSymmetricAndPositiveDefinite) {
  const Recording recording = recordLaps(5);
  for (const double extrinsics_sigma_deg : {0, 1}) {
    SlamConfig with;
    with.msckf.odometry.extrinsics_sigma_deg = extrinsics_sigma_deg;
    const FlightRun run = test::run(recording.frames, recording.odometry, with);
    for (std::size_t i = 0; i < run.results.size(); ++i) {
      const FrameResult& r = run.results[i];
      ASSERT_TRUE(r.T_map_base.matrix().allFinite()) << i;
      ASSERT_EQ(r.covariance, Matrix6d(r.covariance.transpose())) << i;
      // As correlations: metres and radians differ.
      const Vector6d scale = r.covariance.diagonal().cwiseSqrt().cwiseInverse();
      ASSERT_TRUE(scale.allFinite()) << i;
      const Matrix6d correlation = scale.asDiagonal() * r.covariance * scale.asDiagonal();
      ASSERT_GT(test::leastEigenvalue(correlation), 1e-9) << i;
      ASSERT_NEAR(r.sigma_m, std::sqrt(r.covariance.topLeftCorner<3, 3>().trace() / 3), 1e-12);
    }
  }
}

}  // namespace
}  // namespace ardrone_vslam
