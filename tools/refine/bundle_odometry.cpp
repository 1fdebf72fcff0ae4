// SPDX-License-Identifier: BSD-3-Clause
#include "refine/bundle_odometry.hpp"

#include <algorithm>
#include <cmath>

#include "ardrone_vslam/rotation.hpp"
#include "refine/residuals.hpp"

namespace ardrone_vslam {
namespace {

// Of a sigma [m, m/s, rad]: as good as exact; with less the equations are worse than double is.
constexpr double kLeast = 1e-5;

double squared(double value) {
  return value * value;
}

double radians(double degrees) {
  return degrees * M_PI / 180;
}

/// What is up in map: a map of camera poses may have its y axis down, but base's z is up.
Eigen::Vector3d upOf(const FlightRecord& record) {
  Eigen::Vector3d up_map = Eigen::Vector3d::Zero();
  for (const Keyframe& keyframe : record.keyframes) up_map += keyframe.T_map_base.linear().col(2);
  return up_map.normalized();
}

ceres::CostFunction* priorOf(const Eigen::Vector3d& sigma) {
  return costOf<PriorResidual<3>, 3, 3>({sigma});
}

ceres::CostFunction* slowErrorOf(const Eigen::Vector3d& keep, const Eigen::Vector3d& sigma) {
  return costOf<SlowErrorResidual, 3, 3, 3>({keep, sigma.cwiseMax(kLeast)});
}

}  // namespace

BundleOdometry::BundleOdometry(const FlightRecord& record, KeyframeErrors& poses,
                               ceres::Problem& problem)
    : record_(record),
      poses_(poses),
      problem_(problem),
      up_map_(upOf(record)),
      biases_(record.keyframes.size()),
      attitudes_(record.keyframes.size()) {
  if (record.config.odometry.extrinsics_sigma_deg > 0) addExtrinsics();
  addOdometry();
  addHeights();
}

void BundleOdometry::add(ceres::CostFunction* cost, std::initializer_list<double*> of) {
  problem_.AddResidualBlock(cost, nullptr, std::vector<double*>(of));
}

void BundleOdometry::addExtrinsics() {
  for (const Keyframe& keyframe : record_.keyframes) {
    const auto camera = std::find_if(cameras_.begin(), cameras_.end(), [&](const Extrinsics& one) {
      return one.T_base_cam.matrix() == keyframe.T_base_cam.matrix();
    });
    camera_of_.push_back(static_cast<std::size_t>(camera - cameras_.begin()));
    if (camera == cameras_.end()) cameras_.push_back({keyframe.T_base_cam});
  }
  const double sigma_rad = radians(record_.config.odometry.extrinsics_sigma_deg);
  for (Extrinsics& camera : cameras_)
    add(priorOf(Eigen::Vector3d::Constant(sigma_rad)), {camera.error.data()});
}

void BundleOdometry::addAttitude(std::size_t k) {
  const Keyframe& keyframe = record_.keyframes[k];
  const AttitudeResidual residual{keyframe.T_map_base.linear(), keyframe.T_odom_base.linear(),
                                  attitudeAxes_map(k),
                                  radians(record_.config.odometry.attitude_noise_deg)};
  double* pose = poses_[k].data();
  double* attitude = attitudes_[k].data();
  if (cameras_.empty()) {
    add(costOf<AttitudeResidual, 3, 6, 3>(residual), {pose, attitude});
  } else {
    add(costOf<AttitudeResidual, 3, 6, 3, 3>(residual),
        {pose, attitude, cameras_[camera_of_[k]].error.data()});
  }
}

/// An accelerometer that errs tilts about base's axes. Yaw walks about what is up.
Eigen::Matrix3d BundleOdometry::attitudeAxes_map(std::size_t keyframe) const {
  Eigen::Matrix3d axes_map = record_.keyframes[keyframe].T_odom_base.linear();
  axes_map.col(2) = up_map_;
  return axes_map;
}

void BundleOdometry::addOdometry() {
  const OdometryNoiseConfig& noise = record_.config.odometry;
  const double tilt_rad = radians(noise.tilt_sigma_deg);
  // Where the first keyframe is, map begins; yaw is zero by definition.
  add(priorOf(Eigen::Vector3d(tilt_rad, tilt_rad, 0).cwiseMax(kLeast)), {attitudes_[0].data()});
  add(priorOf(Eigen::Vector3d::Constant(std::max(noise.velocity_bias_m_s, kLeast))),
      {biases_[0].data()});
  add(costOf<PriorResidual<1>, 1, 1>({Eigen::Matrix<double, 1, 1>(noise.scale_sigma)}),
      {&scale_error_});
  add(costOf<StartResidual, 3, 6>({kLeast}), {poses_[0].data()});
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    addAttitude(i);
    if (i > 0) addStep(i);
  }
}

void BundleOdometry::addStep(std::size_t to) {
  const OdometryNoiseConfig& noise = record_.config.odometry;
  const Keyframe& before = record_.keyframes[to - 1];
  const Keyframe& after = record_.keyframes[to];
  const double dt_s = 1e-9 * static_cast<double>(after.stamp_ns - before.stamp_ns);
  const auto grown = [dt_s](double time_s) { return std::sqrt(1 - std::exp(-2 * dt_s / time_s)); };

  const double keep_tilt = std::exp(-dt_s / noise.tilt_time_s);
  const double tilt_rad = radians(noise.tilt_sigma_deg) * grown(noise.tilt_time_s);
  const double yaw_rad = std::sqrt(squared(radians(noise.yaw_walk_deg_per_sqrt_s)) * dt_s +
                                   squared(radians(noise.yaw_walk_deg_per_sqrt_m)) * after.way_m);
  add(slowErrorOf({keep_tilt, keep_tilt, 1}, {tilt_rad, tilt_rad, yaw_rad}),
      {attitudes_[to - 1].data(), attitudes_[to].data()});

  const double time_s = noise.velocity_bias_time_s;
  const double bias_m_s = noise.velocity_bias_m_s;
  add(slowErrorOf(Eigen::Vector3d::Constant(std::exp(-dt_s / time_s)),
                  Eigen::Vector3d::Constant(bias_m_s * grown(time_s))),
      {biases_[to - 1].data(), biases_[to].data()});

  // The bias changes on the way, too: for a short one, and for one of many time constants.
  const double by_bias_m2 =
      squared(bias_m_s) * std::min(2 * dt_s * dt_s * dt_s / (3 * time_s), 2 * time_s * dt_s);
  WayResidual way;
  way.from_map = before.T_map_base.translation();
  way.to_map = after.T_map_base.translation();
  way.way_odom_m = after.T_odom_base.translation() - before.T_odom_base.translation();
  way.R_odom_base = before.T_odom_base.linear();
  way.attitude_axes_map = attitudeAxes_map(to - 1);
  way.duration_s = time_s * (1 - std::exp(-dt_s / time_s));  // of a bias that fades
  way.sigma_m = std::max(std::sqrt(after.way_variance_m2 + by_bias_m2), kLeast);
  add(costOf<WayResidual, 3, 6, 6, 3, 3, 1>(way),
      {poses_[to - 1].data(), poses_[to].data(), attitudes_[to - 1].data(), biases_[to - 1].data(),
       &scale_error_});
}

void BundleOdometry::addHeights() {
  floors_map_m_.assign(static_cast<std::size_t>(record_.keyframes.back().floor) + 1, 0.0);
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    const Keyframe& keyframe = record_.keyframes[i];
    if (!keyframe.height_m) continue;
    add(costOf<HeightResidual, 1, 6, 1>({*keyframe.height_m, keyframe.T_map_base.translation().z(),
                                         record_.config.height.height_sigma_m}),
        {poses_[i].data(), &floors_map_m_[static_cast<std::size_t>(keyframe.floor)]});
  }
}

Eigen::Matrix3d BundleOdometry::R_base_rig(std::size_t keyframe) const {
  if (cameras_.empty()) return Eigen::Matrix3d::Identity();
  return rotationOf(Eigen::Vector3d(cameras_[camera_of_[keyframe]].error.data()));
}

std::vector<double*> BundleOdometry::chain() {
  std::vector<double*> blocks;
  for (auto* errors : {&attitudes_, &biases_}) {
    for (Vector& error : *errors) blocks.push_back(error.data());
  }
  return blocks;
}

}  // namespace ardrone_vslam
