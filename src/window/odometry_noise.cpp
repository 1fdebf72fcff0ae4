// SPDX-License-Identifier: BSD-3-Clause
#include "window/odometry_noise.hpp"

#include <algorithm>
#include <optional>

#include "ardrone_vslam/rotation.hpp"
#include "linear/scalars.hpp"
#include "window/window_state.hpp"

namespace ardrone_vslam {

double walkVariance_m2(const OdometryNoiseConfig& config, const OdometryState& from,
                       const OdometryState& to, double displacement_m, double travelled_m) {
  const double dt_s = std::max(seconds(to.stamp_ns - from.stamp_ns), 0.0);
  const double configured_m2 =
      squared(config.walk_m_per_sqrt_m) * displacement_m + squared(config.walk_m_per_sqrt_s) * dt_s;
  const std::optional<double> then = positionVariance_m2(from);
  const std::optional<double> now = positionVariance_m2(to);
  if (!then || !now || !(*now > *then)) return configured_m2;
  // Of what the odometry says of itself the slow velocity error and that of the scale, which grows
  // with the square of the way, are states of their own here. Taken for white noise a second time,
  // they would leave the camera hardly anything to go by.
  const double by_bias_m2 =
      2 * squared(config.velocity_bias_m_s) * config.velocity_bias_time_s * dt_s;
  const double by_scale_m2 =
      squared(config.scale_sigma) * (squared(travelled_m + displacement_m) - squared(travelled_m));
  const double rest_m2 = *now - *then - by_bias_m2 - by_scale_m2;
  return std::max(rest_m2, std::min(configured_m2, *now - *then));
}

void setStart(const OdometryNoiseConfig& config, const Eigen::Matrix3d& R_odom_base,
              CovarianceMatrix::View P) {
  constexpr double kStartSigma_m = 0.001;  // where the first frame is, map begins
  constexpr int kAttitude = WindowState::kAttitude;
  constexpr int kExtrinsics = WindowState::kExtrinsics;
  P.diagonal().segment<3>(WindowState::kBias).setConstant(squared(config.velocity_bias_m_s));
  P(WindowState::kScale, WindowState::kScale) = squared(config.scale_sigma);
  // Yaw is zero by definition; roll and pitch may be off from the start.
  const Eigen::Matrix3d tilt =
      squared(radians(config.tilt_sigma_deg)) * acrossOf(R_odom_base.col(2));
  const int attitude = WindowState::kGlobals + 3;
  P.block<3, 3>(kAttitude, kAttitude) = tilt;
  P.block<3, 3>(attitude, kAttitude) = tilt;
  P.block<3, 3>(kAttitude, attitude) = tilt;
  P.block<3, 3>(attitude, attitude) = tilt;
  P.diagonal().segment<3>(kExtrinsics).setConstant(squared(radians(config.extrinsics_sigma_deg)));
  P.block<3, 3>(attitude, kExtrinsics) = R_odom_base * P.block<3, 3>(kExtrinsics, kExtrinsics);
  P.block<3, 3>(kExtrinsics, attitude) = P.block<3, 3>(attitude, kExtrinsics).transpose();
  P.diagonal().segment<3>(attitude).array() +=
      squared(radians(config.attitude_noise_deg)) + squared(radians(config.extrinsics_sigma_deg));
  P.diagonal().segment<3>(WindowState::kGlobals).setConstant(squared(kStartSigma_m));
}

}  // namespace ardrone_vslam
