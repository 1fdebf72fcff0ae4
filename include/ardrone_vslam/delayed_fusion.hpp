// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "ardrone_vslam/msckf_config.hpp"
#include "ardrone_vslam/odometry_adapter.hpp"
#include "ardrone_vslam/odometry_buffer.hpp"
#include "ardrone_vslam/odometry_config.hpp"

namespace ardrone_vslam {

/// What the mapper says of one image: base was at T_map_base where the odometry said T_odom_base.
struct LateCorrection {
  std::int64_t stamp_ns = 0;                                     ///< the image's
  Eigen::Isometry3d T_map_base = Eigen::Isometry3d::Identity();  ///< fused
  Eigen::Isometry3d T_odom_base =
      Eigen::Isometry3d::Identity();  ///< by the odometry at the same stamp
  /// Of T_map_base: position [m^2], rotation vector [rad^2], axes of map.
  Matrix6d covariance = Matrix6d::Zero();
};

/// What is wrong with a correction (not finite, out of bounds, covariance that is none), and what
/// helps; empty when nothing is.
std::string faultOf(const LateCorrection& correction);

/// The odometry's state of one instant, seen from map.
struct MapState {
  std::int64_t stamp_ns = 0;                                     ///< the odometry's
  Eigen::Isometry3d T_map_base = Eigen::Isometry3d::Identity();  ///< the odometry's pose, corrected
  /// Position [m^2], rotation vector [rad^2], axes of map; symmetric, positive semi-definite.
  Matrix6d covariance = Matrix6d::Zero();
  Vector6d twist_base = Vector6d::Zero();        ///< the odometry's, as in OdometryState
  Matrix6d twist_covariance = Matrix6d::Zero();  ///< the odometry's, as in OdometryState
};

/// Applies corrections, which are late by the image's way through camera and mapper, to the live
/// odometry: T_map_odom is that of the newest correction, and all odometry since its stamp is seen
/// through it. The odometry's relative motion stays as it is, so a correction is exact however late
/// it comes.
class DelayedFusion {
 public:
  /// What became of a correction.
  enum class Answer {
    kUsed,      ///< all odometry since its stamp is seen through it
    kNotYet,    ///< no odometry at or after the stamp has come: to be offered again when it has
    kTooOld,    ///< before the oldest odometry that is kept
    kGap,       ///< the odometry has a hole at the stamp
    kNotAfter,  ///< not after the correction in use
    kOtherOdometry,  ///< its T_odom_base is not where the odometry was
    kBad             ///< faultOf(correction) says what
  };
  /// A correction whose odometry pose is further off the odometry belongs to another one:
  /// interpolation across some lost messages costs less.
  static constexpr double kLargestDifference_m = 0.1;
  /// The same for its attitude.
  static constexpr double kLargestDifference_rad = 0.1;

  /// @throws ConfigError listing every parameter out of its range
  explicit DelayedFusion(const DelayedFusionConfig& config);

  /// Appends odometry; one that is refused changes nothing. Of another OdometryState::start than
  /// before: clear() first. O(1).
  OdometryBuffer::Push push(const OdometryState& state);

  /// Only with kUsed it changes anything. O(odometry since the stamp).
  Answer correct(const LateCorrection& correction);

  /// The newest odometry in map; nothing before the first correction or without odometry.
  std::optional<MapState> newest() const;

  /// All odometry from the correction's stamp on, oldest first, re-propagated by it.
  std::vector<MapState> sinceCorrection() const;

  /// Forgets odometry and correction: time or the odometry began anew.
  void clear();

  /// Whether a correction is in use.
  bool hasCorrection() const { return correction_.has_value(); }
  /// @pre hasCorrection()
  std::int64_t correctionStamp_ns() const { return correction_->stamp_ns; }
  /// Of the correction in use; identity before the first one.
  const Eigen::Isometry3d& T_map_odom() const { return T_map_odom_; }
  /// Of the odometry; 0 without any.
  std::int64_t newestStamp_ns() const { return buffer_.newestStamp_ns(); }

 private:
  MapState inMap(const OdometryState& state, double travelled_m) const;
  /// What the odometry's error can have grown by since the correction's stamp.
  Matrix6d growth(const OdometryState& state, double travelled_m) const;

  DelayedFusionConfig config_;
  OdometryBuffer buffer_;
  std::optional<LateCorrection> correction_;
  OdometryState at_correction_;  // the odometry at its stamp
  Eigen::Isometry3d T_map_odom_ = Eigen::Isometry3d::Identity();
  double travelled_m_ = 0;  // of the odometry since then
};

}  // namespace ardrone_vslam
