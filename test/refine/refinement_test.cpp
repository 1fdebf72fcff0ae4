// SPDX-License-Identifier: BSD-3-Clause
#include "refine/refinement.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ardrone_vslam/rotation.hpp"
#include "recorded_flight.hpp"

namespace ardrone_vslam {
namespace {

using test::FlightErrors;
using test::RecordedFlight;

/// Length of the refined way over the true one.
double scaleOf(const RecordedFlight& flight, const Refinement& refined) {
  double way_m = 0;
  double true_m = 0;
  for (std::size_t i = 1; i < flight.truth.size(); ++i) {
    way_m += (refined.T_map_base[i].translation() - refined.T_map_base[i - 1].translation()).norm();
    true_m += (flight.truth[i].translation() - flight.truth[i - 1].translation()).norm();
  }
  return way_m / true_m;
}

FlightErrors drifting() {
  FlightErrors errors;
  errors.corner_px = 0.5;
  errors.bias_m_s << 0.06, -0.04, 0.02;
  errors.yaw_rad_per_s = 0.001;
  return errors;
}

TEST(Refinement, NothingComesOfNothing) {
  const Refinement refined = refine({});
  EXPECT_TRUE(refined.T_map_base.empty());
  EXPECT_TRUE(refined.points.empty());
}

TEST(Refinement, ExactMeasurementsGiveTheExactFlight) {
  RecordedFlight flight{FlightErrors{}};
  for (std::size_t k = 1; k < flight.record.keyframes.size(); ++k) {
    Eigen::Isometry3d& T = flight.record.keyframes.change(k).T_map_base;
    const auto x = static_cast<double>(k);
    T.translation() += 0.03 * Eigen::Vector3d(std::sin(x), std::cos(2 * x), std::sin(3 * x));
    T.linear() = rotationAboutZ(0.01 * std::sin(5 * x)) * T.linear();
  }
  const Refinement refined = refine(flight.record);
  EXPECT_LT(flight.rmse_m(refined.T_map_base), 1e-5);
  EXPECT_EQ(refined.views_left_out, 0U);
  EXPECT_GT(refined.points.size(), flight.points.size());  // of tracks, and of landmarks
  for (const TrackPoint3d& point : refined.points) {
    const Eigen::Vector3d& truth = flight.points[point.landmark_id - 1];
    EXPECT_LT((point.position_map - truth).norm(), 1e-4);
  }
}

TEST(Refinement, ManyKeyframesAreSolvedByConjugateGradients) {
  FlightErrors errors = drifting();
  errors.bias_m_s *= 0.1;
  errors.yaw_rad_per_s *= 0.1;
  const RecordedFlight flight{errors, 7, 520};
  ASSERT_GT(flight.rmse_m(flight.before()), 0.3);
  const Refinement refined = refine(flight.record);
  EXPECT_LT(flight.rmse_m(refined.T_map_base), 0.2);  // 0.144 measured
}

TEST(Refinement, WithTooFewViewsItIsRefused) {
  RecordedFlight flight{drifting()};
  auto& keyframes = flight.record.keyframes;
  for (std::size_t k = 0; k < keyframes.size(); ++k) keyframes.change(k).views.resize(1);
  EXPECT_THROW(refine(flight.record), std::runtime_error);
  keyframes = {keyframes.front()};
  EXPECT_THROW(refine(flight.record), std::runtime_error);
}

TEST(Refinement, TakesOutWhatTheOdometryDrifts) {
  const RecordedFlight flight{drifting()};
  ASSERT_GT(flight.rmse_m(flight.before()), 0.3);
  const Refinement refined = refine(flight.record);
  EXPECT_LT(flight.rmse_m(refined.T_map_base), 0.11);  // 0.091 measured
  EXPECT_TRUE(refined.T_map_base.front().isApprox(flight.truth.front(), 0.01));
}

/// In a map whose y axis is down, as of many recordings.
TEST(Refinement, WhatIsUpBaseTells) {
  const RecordedFlight flight{drifting()};
  RecordedFlight turned = flight;
  const Eigen::Isometry3d down(Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitX()));
  for (std::size_t k = 0; k < turned.record.keyframes.size(); ++k) {
    Keyframe& keyframe = turned.record.keyframes.change(k);
    keyframe.T_map_base = down * keyframe.T_map_base;
    keyframe.T_odom_base = down * keyframe.T_odom_base;
  }
  const Refinement expected = refine(flight.record);
  const Refinement refined = refine(turned.record);
  for (std::size_t k = 0; k < expected.T_map_base.size(); ++k)
    EXPECT_TRUE(refined.T_map_base[k].isApprox(down * expected.T_map_base[k], 1e-3)) << k;
}

/// Its tracks have no parallax, and none goes on when the flight does.
TEST(Refinement, ARestAtTheBeginHoldsWhereItWas) {
  constexpr std::size_t kRest = 6;
  RecordedFlight flight{FlightErrors{}};
  const auto flown = flight.record.keyframes;
  flight.record.keyframes = {};
  for (std::size_t k = 0; k < kRest + flown.size(); ++k) {
    Keyframe keyframe = flown[k < kRest ? 0 : k - kRest];
    keyframe.stamp_ns = 500'000'000 * static_cast<std::int64_t>(k + 2);
    if (k < kRest) {
      keyframe.landmarks.clear();
      for (KeyframeView& view : keyframe.views) view.track_id += 10'000;
      if (k > 0) keyframe.way_variance_m2 = 1e-4;
    }
    // The odometry moves meanwhile.
    const Eigen::Vector3d drift_m(0.02 * static_cast<double>(std::min(k, kRest)), 0, 0);
    keyframe.T_map_base.translation() += drift_m;
    keyframe.T_odom_base.translation() += drift_m;
    flight.record.keyframes.push_back(keyframe);
  }
  const Refinement refined = refine(flight.record);
  const Eigen::Vector3d moved_m =
      refined.T_map_base[kRest].translation() - refined.T_map_base[0].translation();
  EXPECT_LT(moved_m.norm(), 0.03);  // 0.12 by the odometry, 0.02 measured
}

TEST(Refinement, OfWhatViewsHaveInCommonTheFiltersPartIsLeftOut) {
  RecordedFlight flight{drifting()};
  const auto refinedWith = [&flight](double common_px) {
    flight.record.config.track_common_px = common_px;
    return refine(flight.record).T_map_base.back().translation().eval();
  };
  const Eigen::Vector3d at_most = refinedWith(0.7);
  EXPECT_LT((refinedWith(3.5) - at_most).norm(), 1e-6);
  EXPECT_GT((refinedWith(0.3) - at_most).norm(), 1e-3);
}

TEST(Refinement, ViewsOfOtherPointsAreLeftOut) {
  FlightErrors errors = drifting();
  errors.wrong_views = 0.05;
  const RecordedFlight flight{errors};
  const Refinement refined = refine(flight.record);
  EXPECT_LT(flight.rmse_m(refined.T_map_base), 0.12);  // 0.095 measured
  EXPECT_GT(refined.views_left_out, refined.views / 100);
}

TEST(Refinement, AloneTheCameraKeepsTheScaleOfTheOdometry) {
  FlightErrors errors;
  errors.corner_px = 0.5;
  errors.scale = 1.08;
  const RecordedFlight flight{errors};
  EXPECT_NEAR(scaleOf(flight, refine(flight.record)), 1.08, 0.02);
}

TEST(Refinement, HeightsTellTheScale) {
  FlightErrors errors;
  errors.corner_px = 0.5;
  errors.scale = 1.08;
  errors.height_m = 0.01;
  const RecordedFlight flight{errors};
  EXPECT_NEAR(scaleOf(flight, refine(flight.record)), 1, 0.01);
}

TEST(Refinement, ExtrinsicsThatAreOffAreFound) {
  FlightErrors errors;
  errors.corner_px = 0.5;
  RecordedFlight flight{errors};
  const Eigen::Vector3d off_rad(0.01, -0.015, 0.02);
  auto& keyframes = flight.record.keyframes;
  for (std::size_t k = 0; k < keyframes.size(); ++k) {
    Eigen::Isometry3d& T_base_cam = keyframes.change(k).T_base_cam;
    T_base_cam = Eigen::Isometry3d(rotationOf(off_rad)).inverse() * T_base_cam;
  }
  // With that of the default a slow way sideways is as likely as a turned camera.
  flight.record.config.odometry.velocity_bias_m_s = 0.002;
  const double taken_as_exact_m = flight.rmse_m(refine(flight.record).T_map_base);
  flight.record.config.odometry.extrinsics_sigma_deg = 1;
  const Refinement refined = refine(flight.record);
  // The tilt about base's axes takes most of it.
  ASSERT_GT(taken_as_exact_m, 0.02);
  EXPECT_LT(flight.rmse_m(refined.T_map_base), 0.007);  // 0.0053 measured
  for (const Eigen::Matrix3d& R_base_rig : refined.R_base_rig)
    EXPECT_LT((rotationVectorOf(R_base_rig) - off_rad).norm(), 0.005);  // 0.0037 measured
}

TEST(Refinement, TellsHowFarItIs) {
  const RecordedFlight flight{FlightErrors{}};
  std::vector<double> shares;
  refine(flight.record, {}, [&shares](double share) { shares.push_back(share); });
  ASSERT_FALSE(shares.empty());
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_LE(shares.back(), 1);
}

}  // namespace
}  // namespace ardrone_vslam
