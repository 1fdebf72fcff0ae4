// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "ardrone_vslam/features.hpp"

namespace ardrone_vslam {

/// Tells odometry that stands still for ever (all zeros, a topic that nobody fills) from a camera
/// that stands still: the tracks move, by more than the odometry's turning explains, and the
/// camera's position does not.
class StandstillWatch {
 public:
  static constexpr std::int64_t kPatience_ns = 3'000'000'000;
  static constexpr double kRest_m = 1e-6;     // as the offline tools
  static constexpr double kMotion_px = 3;     // more than corners jump about
  static constexpr std::size_t kTracks = 10;  // fewer say nothing

  /// One image; O(n log n) in its features.
  /// @param T_odom_cam  optical frame to odom, by the odometry alone
  void see(const ImageFeatures& features, const Eigen::Isometry3d& T_odom_cam);

  /// Whether the tracks moved for kPatience_ns on end without the odometry, which has not moved
  /// since.
  bool isStuck() const { return is_stuck_; }

  void reset() { *this = {}; }

 private:
  using Ray = std::pair<std::uint32_t, Eigen::Vector3d>;  // track id, unit vector in the odom frame

  struct Motion {
    std::size_t tracks = 0;
    double seen_rad = 0;         // median, in the camera
    double unexplained_rad = 0;  // median, after the odometry's turning is taken out
  };

  Motion motionTo(const std::vector<Ray>& rays, const Eigen::Matrix3d& R_odom_cam) const;
  void begin(std::int64_t stamp_ns, const Eigen::Matrix3d& R_odom_cam, std::vector<Ray> rays);

  bool has_reference_ = false;
  std::int64_t stamp_ns_ = 0;  // of the image that the following ones are compared with
  Eigen::Matrix3d R_odom_cam_ = Eigen::Matrix3d::Identity();  // then
  std::vector<Ray> rays_;                                     // then, by ascending id
  Eigen::Vector3d position_odom_ = Eigen::Vector3d::Zero();   // where the camera came to rest
  std::int64_t moving_ns_ = 0;
  bool is_stuck_ = false;
};

/// A sentence for users.
std::string explainStandstill(const std::string& odometry_topic);

}  // namespace ardrone_vslam
