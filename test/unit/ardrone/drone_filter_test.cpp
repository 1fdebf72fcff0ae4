// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone/drone_filter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "ardrone_vslam/rotation.hpp"
#include "support/eigenvalues.hpp"

namespace ardrone_vslam {
namespace {

using State = DroneFilter::State;

constexpr double kGravity_m_s2 = 9.81;

class DroneFilterTest : public ::testing::Test {
 protected:
  State anyState() {
    State x;
    for (int i = 0; i < drone_model::kSize; ++i) x[i] = 0.2 * normal_(random_);
    x.segment<3>(drone_model::kVelocity) *= 5;
    x.segment<2>(drone_model::kTilt) *= 0.2;
    return x;
  }
  DroneMeasurement anyMeasurement() {
    DroneMeasurement m;
    m.R_odom_base =
        rotationOf({0.2 * normal_(random_), 0.2 * normal_(random_), 2 * normal_(random_)});
    m.flow_base_m_s << normal_(random_), normal_(random_);
    m.force_base_m_s2 << normal_(random_), normal_(random_), kGravity_m_s2 + normal_(random_);
    m.height_m = 1 + 0.1 * normal_(random_);
    return m;
  }
  /// Central differences of what depends on the state.
  template <class Function>
  static Eigen::MatrixXd differences(const State& x, const Function& function) {
    constexpr double kStep = 1e-6;
    Eigen::MatrixXd J(function(x).size(), x.size());
    for (int i = 0; i < x.size(); ++i) {
      const State step = kStep * State::Unit(i);
      J.col(i) = (function(x + step) - function(x - step)) / (2 * kStep);
    }
    return J;
  }

  std::mt19937 random_{1};
  std::normal_distribution<double> normal_;
};

TEST_F(DroneFilterTest, JacobiansAreTheDerivatives) {
  for (int i = 0; i < 20; ++i) {
    const State x = anyState();
    const DroneMeasurement m = anyMeasurement();
    const double dt_s = 0.02;
    EXPECT_TRUE(drone_model::motionJacobian(x, m, dt_s)
                    .isApprox(differences(x,
                                          [&](const State& s) -> Eigen::VectorXd {
                                            return drone_model::motion(s, m, dt_s);
                                          }),
                              1e-7));
    EXPECT_TRUE(
        drone_model::flow(x, m.R_odom_base)
            .jacobian.isApprox(differences(x,
                                           [&](const State& s) -> Eigen::VectorXd {
                                             return drone_model::flow(s, m.R_odom_base).value;
                                           }),
                               1e-7));
    EXPECT_TRUE(
        drone_model::drag(x, m.R_odom_base)
            .jacobian.isApprox(differences(x,
                                           [&](const State& s) -> Eigen::VectorXd {
                                             return drone_model::drag(s, m.R_odom_base).value;
                                           }),
                               1e-7));
  }
}

TEST_F(DroneFilterTest, TheCovarianceStaysOneWhateverIsMeasured) {
  DroneFilter filter;
  filter.begin(anyMeasurement());
  for (int i = 0; i < 2000; ++i) {
    const DroneMeasurement m = anyMeasurement();
    filter.predict(m, 0.005, static_cast<DroneFilter::Known>(i % 100 == 0));
    if (i % 3 == 0) filter.updateVelocity(m, 0.005);
    if (i % 5 == 0) filter.updateHeight(m.height_m, 0.005);
    if (i % 500 == 250) filter.changeFloor(i % 1000 == 250 ? 0.7 : 0.0);
    if (i % 700 > 680) filter.rest(0.005);
    if (i % 900 == 899) filter.widen(1, 1);
    const auto& P = filter.covariance();
    ASSERT_TRUE(P.isApprox(P.transpose(), 1e-12)) << i;
    ASSERT_GT(test::leastEigenvalue(P), 0) << i;
    const Matrix6d pose = filter.observed(m.R_odom_base).covariance;
    ASSERT_EQ(pose, pose.transpose());
    ASSERT_GT(test::leastEigenvalue(pose), 0);
  }
}

TEST_F(DroneFilterTest, TheAccelerometerTellsTheSpeedByTheDrag) {
  DroneErrors errors;
  errors.force_bias_m_s2 = 0.001;
  errors.drag_sigma_per_s = 0.001;
  errors.flow_bias_m_s = 1;  // the flow says next to nothing
  DroneFilter filter(errors);
  DroneMeasurement m;
  constexpr double kSpeed_m_s = 1;
  // The tilt against the drag, forward.
  const double lean_rad = std::atan(errors.drag_per_s * kSpeed_m_s / kGravity_m_s2);
  m.R_odom_base = rotationOf({0, lean_rad, 0});
  m.force_base_m_s2 = m.R_odom_base.transpose() * Eigen::Vector3d(0, 0, kGravity_m_s2);
  filter.begin(m);
  for (int i = 0; i < 4000; ++i) {
    filter.predict(m, 0.005);
    filter.updateVelocity(m, 0.005);
  }
  EXPECT_NEAR(filter.state()[drone_model::kVelocity], kSpeed_m_s, 0.05);
  EXPECT_NEAR(filter.state()[drone_model::kVelocity + 1], 0, 0.05);
}

}  // namespace
}  // namespace ardrone_vslam
