// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "window/window_state.hpp"

namespace ardrone_vslam {

struct Landmark;

/// Takes the landmarks of one anchor along when it has been corrected.
struct AnchorCorrection {
  std::uint32_t anchor_id = 0;      ///< whose landmarks
  std::uint32_t new_anchor_id = 0;  ///< to which they belong from now on
  Eigen::Vector3d from_map =
      Eigen::Vector3d::Zero();  ///< where base of the anchor stood when they were placed
  Eigen::Vector3d to_map = Eigen::Vector3d::Zero();        ///< where it stands now
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< its rotation since then, axes of map
  double stretch = 1;  ///< of their distance from it since then, by corrections of the scale

  /// Moves position, view direction and covariance of a landmark of the anchor, and gives it the
  /// new one.
  void apply(Landmark& landmark) const;
};

/// Remembers where the anchors stood when their landmarks were placed, so that these follow them.
class ReAnchoring {
 public:
  /// Landmarks will belong to this frame.
  void begin(const Clone& frame);
  /// One anchor's landmarks go to another, which must have been begun, too.
  void join(const Clone& anchor, std::uint32_t to_anchor_id);
  /// What is to be moved now: landmarks of joined anchors, and those whose anchor has moved so much
  /// that it shows in the image.
  /// @param distance_m     of landmarks from their anchors
  /// @param tolerance_rad  angle that does not matter
  std::vector<AnchorCorrection> take(const WindowState& state, double distance_m,
                                     double tolerance_rad);

 private:
  std::vector<Clone>::iterator placeOf(std::uint32_t id);

  std::vector<Clone> placed_;   // ascending in id
  std::vector<char> is_there_;  // for each of placed_, whether the state still has it
  std::vector<AnchorCorrection> joined_;
};

}  // namespace ardrone_vslam
