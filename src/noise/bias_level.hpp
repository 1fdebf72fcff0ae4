// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace ardrone_vslam {

/// What was learned of the odometry's noise is forgotten over so much: the bias is to have changed
/// some times meanwhile (velocity_bias_time_s).
constexpr double kNoiseMemory_s = 60;

/// How large the slow error of the odometry's velocity is: begins as configured and is learned from
/// the bias that the filter finds, by expectation maximisation on line (Cappe and Moulines,
/// "On-line expectation-maximization algorithm for latent data models", 2009). The expected square
/// of the bias, which counts what is not known of it, goes into a mean over the last minute. So
/// what nothing tells stays as configured. Innovations would not do: each is small, all go the same
/// way.
class BiasLevel {
 public:
  /// @param configured_m_s  standard deviation per axis, to begin with; 0: no bias is looked for
  explicit BiasLevel(double configured_m_s);

  /// What is found counts by the time that it stood for.
  /// @param bias_m_s  the filter's mean
  /// @param covariance  the filter's, of this mean [m^2/s^2]
  /// @param inflation  known factor in the covariance, see Propagator::inflate(); above 0
  void learn(const Eigen::Vector3d& bias_m_s, const Eigen::Matrix3d& covariance, double inflation,
             double duration_s);
  /// What was learned is forgotten.
  void reset();

  /// Per axis [m^2/s^2].
  double variance() const { return variance_; }
  /// Its root.
  double sigma_m_s() const { return std::sqrt(variance_); }

 private:
  double configured_variance_;
  double variance_;
  double learned_s_ = 0;
};

}  // namespace ardrone_vslam
