// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>

#include "simulation/odometry_model.hpp"

namespace ardrone_vslam {

/// What simulateOdometry makes of true poses, one by one as they come: the profile's noise, biases
/// and scale error, but not what happens on the way to the computer. Equal poses and seeds give
/// equal answers.
class OdometryDrift {
 public:
  OdometryDrift(const OdometryProfile& profile, std::uint64_t seed);
  ~OdometryDrift();

  /// T_odom_base as reported. To be called each 1 / rate_hz; the first pose's position is odom's.
  /// @param since_first_s  of this pose, for profiles that change
  Eigen::Isometry3d report(const Eigen::Isometry3d& T_map_base, double since_first_s);
  /// Reported lengths are (1 + scaleError()) times the true ones; 0 for the truth.
  double scaleError() const { return scale_error_; }

 private:
  struct Noise;

  void changeProfile(double since_first_s);

  OdometryProfile profile_;
  double scale_error_ = 0;
  std::size_t next_ = 0;          // of profile_.later
  std::unique_ptr<Noise> noise_;  // nothing: the truth
  bool has_last_ = false;
  Eigen::Isometry3d T_map_last_ = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d T_odom_last_ = Eigen::Isometry3d::Identity();
};

}  // namespace ardrone_vslam
