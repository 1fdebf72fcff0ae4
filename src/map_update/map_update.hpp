// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "ardrone_vslam/msckf_config.hpp"
#include "map_update/blind_stretch.hpp"
#include "map_update/innovation_consistency.hpp"
#include "map_update/map_fix.hpp"
#include "window/propagator.hpp"
#include "window/window_state.hpp"

namespace ardrone_vslam {

/// A landmark as seen by the newest frame.
struct LandmarkObservation {
  Eigen::Vector3d bearing_rig = Eigen::Vector3d::UnitX();   ///< measured unit ray, axes of the rig
  Eigen::Vector3d point_map = Eigen::Vector3d::Zero();      ///< where the map has it
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Zero();  ///< Landmark::covariance_m2
  std::uint32_t anchor_id = 0;                              ///< Landmark::anchor_id
  double window_rad = M_PI;  ///< it was looked for so far around its prediction
};

/// What a fix makes of an observation.
enum class ObservationVerdict {
  kUnjudged,     ///< nothing: a young landmark, or there was no fix
  kAgrees,       ///< with an accepted fix
  kContradicts,  ///< an accepted fix
  kDoubtful      ///< found in a wide window, and no fix says that it is right
};

/// Corrects the newest pose by landmarks of earlier visits: consensus, gate, verdict on each
/// landmark, and how consistent the innovations are.
class MapUpdate {
 public:
  /// @param config  is taken as valid: the filter that holds it has checked it
  explicit MapUpdate(const MsckfConfig& config) : config_(config) {}

  /// A new frame, in which no landmark has been compared yet.
  void beginFrame();
  /// Corrects the state by the newest frame's landmarks, once the drift since they were made is
  /// worth it. O(samples x observations + coordinates^2).
  /// @param camera_rig  the camera's position in the rig
  /// @param propagator  learns how much worse the odometry is than configured
  FixOutcome apply(const std::vector<LandmarkObservation>& observations,
                   const Eigen::Vector3d& camera_rig, double focal_length_px,
                   Propagator& propagator, WindowState& state);
  /// The frame's landmarks are not used: none of them is judged.
  void skip(std::size_t observations);

  /// Of the observations given last.
  const std::vector<ObservationVerdict>& verdicts() const { return verdicts_; }
  /// Landmarks of earlier visits agree with the newest pose.
  bool isLocated() const;
  /// Squared deviations of the fixes over what the covariance says of them, mean of the last ten or
  /// so: 1 is honest.
  double nis() const { return consistency_.nis(); }
  /// nis() when the newest frame had a fix to compare.
  std::optional<double> comparedNis() const;
  /// What was learned of the fixes is forgotten.
  void reset() { consistency_ = {}; }
  /// The camera may have been carried, until then or elsewhere.
  BlindStretch& blindStretch() { return blind_; }

 private:
  /// Of one frame: what the steps below have in common.
  struct Frame {
    const Eigen::Vector3d& camera_rig;
    double angle_sigma_rad;  // of a ray
    Propagator& propagator;
    WindowState& state;
  };

  FixOutcome fix(const std::vector<LandmarkObservation>& observations, Frame& frame);
  FixOutcome fixByFew(const std::vector<MapObservation>& observations, Frame& frame);
  FixOutcome fixByMost(const std::vector<MapObservation>& observations, Frame& frame);
  FixOutcome update(const ObservationConsensus& consensus, double gate_sigmas, Frame& frame);
  void judge(const std::vector<MapObservation>& observations,
             const ObservationConsensus& consensus);

  MsckfConfig config_;
  InnovationConsistency consistency_;
  std::vector<ObservationVerdict> verdicts_;
  FixOutcome outcome_ = FixOutcome::kNone;  // of the newest frame
  bool was_compared_ = false;               // at the newest frame
  BlindStretch blind_;
};

}  // namespace ardrone_vslam
