// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ardrone_vslam/odometry_buffer.hpp"

namespace ardrone_vslam {

/// Are the fixes as far off as the covariance says, and if not, who is to blame? Odometry that
/// drifts faster than configured pulls one fix after the other the same way; a map that is worse
/// than it claims pulls them to and fro. Both are means over the last ten fixes or so.
class InnovationConsistency {
 public:
  /// @param whitened  the fix's offset in sigmas (MapFix)
  void learn(const Vector6d& whitened);

  /// Normalised innovation squared over its coordinates: 1 is honest.
  double nis() const { return nis_; }
  /// By how much, in variance, the odometry's velocity is worse than configured; at least 1.
  double odometryFactor() const;
  /// By how much, in variance, the fixes are worse than they claim; at least 1.
  double mapFactor() const;

 private:
  /// What the fixes have in common, of nis().
  double common() const;

  double nis_ = 1;
  Vector6d mean_ = Vector6d::Zero();
};

}  // namespace ardrone_vslam
