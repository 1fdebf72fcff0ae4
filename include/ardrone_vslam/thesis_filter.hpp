// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "ardrone_vslam/observer_buffer.hpp"
#include "ardrone_vslam/parameters.hpp"

namespace ardrone_vslam {

/// How landmarks give a position.
enum class MeanKind {
  kPrinted,  ///< the thesis's weighted mean (6.4)
  kExact     ///< weighted least squares over the rays
};
template <>
struct EnumNames<MeanKind> {
  static constexpr std::array<const char*, 2> kNames{"printed", "exact"};
};

/// How landmarks and odometry are weighed, and which fixes are rejected.
struct ThesisFilterConfig {
  MeanKind mean = MeanKind::kPrinted;
  double outlier_deviations = 3.0;
  bool common_drift = true;
  int min_landmarks = 10;
  double initial_deviation_m = 0.01;
  double observer_noise_m_per_sqrt_m = 0.015;
  double observer_noise_m_per_sqrt_s = 0.06;
  double fix_deviation_floor_m = 0.01;
  double fix_angle_floor_deg = 2.0;
  double gate_deviations = 5.0;
  double attitude_deviation_deg = 0.3;
};

template <class Visitor>
void visitParameters(ThesisFilterConfig& c, Visitor&& visit) {
  visit(
      ParameterInfo{
          "mean", "choice", 0, 0,
          "printed: weighted mean (6.4), damped along the rays; exact: weighted least squares, "
          "undamped, for odometry without drift of scale"},
      c.mean);
  visit(ParameterInfo{"outlier_deviations", "-", 0, 1e6,
                      "mean exact: a landmark that lies this many robust deviations off its ray "
                      "weighs a quarter, further ones hardly anything; 0: all weigh fully"},
        c.outlier_deviations);
  visit(ParameterInfo{"common_drift", "switch", 0, 0,
                      "on: landmarks share the drift of the time they were made, so fresh ones "
                      "correct little and old ones all; "
                      "off: independent, as printed"},
        c.common_drift);
  visit(ParameterInfo{"min_landmarks", "landmarks", 1, 1000, "fewer matched landmarks give no fix"},
        c.min_landmarks);
  visit(
      ParameterInfo{"initial_deviation_m", "m", 1e-6, 100, "position deviation at the first image"},
      c.initial_deviation_m);
  visit(
      ParameterInfo{
          "observer_noise_m_per_sqrt_m", "m/sqrt(m)", 0, 10,
          "odometry noise per square root of the way, where the observer gives no covariance"},
      c.observer_noise_m_per_sqrt_m);
  visit(
      ParameterInfo{
          "observer_noise_m_per_sqrt_s", "m/sqrt(s)", 0, 10,
          "odometry noise per square root of time, where the observer gives no covariance"},
      c.observer_noise_m_per_sqrt_s);
  visit(ParameterInfo{"fix_deviation_floor_m", "m", 0, 10,
                      "errors that all landmarks share: no fix is taken as better than this"},
        c.fix_deviation_floor_m);
  visit(
      ParameterInfo{
          "fix_angle_floor_deg", "deg", 0, 45,
          "the same for errors that grow with the landmarks' distance: attitude and calibration"},
      c.fix_angle_floor_deg);
  visit(ParameterInfo{"gate_deviations", "-", 0.5, 1e6,
                      "a fix further off the prediction than this many deviations is rejected"},
        c.gate_deviations);
  visit(ParameterInfo{"attitude_deviation_deg", "deg", 0, 90,
                      "the observer's attitude, for the published covariance"},
        c.attitude_deviation_deg);
}

/// One matched landmark as the localisation sees it.
struct Sighting {
  Eigen::Vector3d landmark_map = Eigen::Vector3d::Zero();    ///< where the map has it
  Eigen::Vector3d direction_map = Eigen::Vector3d::UnitX();  ///< measured unit ray
  double landmark_deviation_m = 0;                           ///< sigma_l
  double position_variance_m2 = 0;  ///< of the pose when the landmark was made (P_a)
};

/// A camera position by landmarks alone.
struct PositionFix {
  double distance_m = 0;          ///< weighted mean distance of the landmarks
  double shared_variance_m2 = 0;  ///< weighted mean of the sightings' P_a
  Eigen::Vector3d position_map = Eigen::Vector3d::Zero();  ///< of the camera
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();    ///< of it [m^2]
};

/// The thesis's localisation (chapter 6): weighted mean of the positions that each landmark gives,
/// fused with the observer's prediction by a Kalman filter. Orientation is the observer's, taken as
/// drift-free.
class ThesisFilter {
 public:
  /// @throws ConfigError listing every parameter out of its range
  explicit ThesisFilter(const ThesisFilterConfig& config);

  /// Starts at a base position.
  void start(const Eigen::Vector3d& position_map, const ObserverState& observer);
  /// Moves on by the observer's increment since the last call; the deviation grows by the increase
  /// of the observer's covariance or, where it gives none (positionVariance_m2), by the configured
  /// noise.
  void predict(const ObserverState& observer);

  /// The camera's position by landmarks (6.1-6.4; `exact`: least squares over the
  /// landmarks' rays, undamped along them).
  /// @param predicted_camera_map  p_hat of (6.2)
  /// @param angle_deviation_rad   sigma_a
  /// @return nothing for fewer than `min_landmarks`, or when they fix no position
  std::optional<PositionFix> locate(const std::vector<Sighting>& sightings,
                                    const Eigen::Vector3d& predicted_camera_map,
                                    double angle_deviation_rad) const;

  /// Kalman fusion (6.8-6.12) of a base position.
  /// @return false when the fix fails its gate; the prediction then stands
  bool fuse(const PositionFix& base_fix);

  /// Of base, fused.
  const Eigen::Vector3d& position_map() const { return position_map_; }
  /// Of position_map() [m^2].
  const Eigen::Matrix3d& covariance() const { return covariance_; }
  /// Per axis: root of the mean variance.
  double deviation_m() const;

 private:
  PositionFix printedMean(const std::vector<Sighting>& sightings, const Eigen::Vector3d& predicted,
                          double sigma_a) const;
  std::optional<PositionFix> exactMean(const std::vector<Sighting>& sightings,
                                       const Eigen::Vector3d& predicted, double sigma_a) const;
  std::optional<PositionFix> leastSquares(const std::vector<Sighting>& sightings,
                                          const Eigen::Vector3d& predicted, double sigma_a,
                                          const std::vector<double>& trust) const;
  /// Weights in (0, 1] by how well each sighting agrees with a camera position.
  std::vector<double> trustIn(const std::vector<Sighting>& sightings,
                              const Eigen::Vector3d& camera_map, double sigma_a) const;

  ThesisFilterConfig config_;
  ObserverState observer_;
  Eigen::Vector3d position_map_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Zero();
};

}  // namespace ardrone_vslam
