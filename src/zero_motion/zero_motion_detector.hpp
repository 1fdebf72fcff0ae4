// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "ardrone_vslam/features.hpp"
#include "zero_motion/reference_image.hpp"
#include "zero_motion/stillness.hpp"

namespace ardrone_vslam {

/// What the image alone says of the camera's motion.
enum class CameraMotion {
  kUnknown,   ///< too few tracks, or not still for long enough
  kMoving,    ///< it shifts, or turns otherwise than the odometry does
  kResting,   ///< still
  kRotating,  ///< turning on the spot
};

/// Tells a camera that rests or turns on the spot from one that moves: compares each image with a
/// reference that stays while nothing moves, so that creeping is seen. Tracks that break are found
/// again in the reference by their descriptors.
class ZeroMotionDetector {
 public:
  /// Compares an image, later than all before, with the reference. O(features log features).
  CameraMotion see(const ImageFeatures& features, const OdometryRotation& odometry);

  /// Whether the image seen last became the reference: there was none, it moved, or the old one has
  /// too little in common with it (the motion then goes on).
  bool isReference() const { return is_reference_; }
  /// Since when it has been still [s].
  double still_s() const { return still_s_; }
  /// Of the image seen last.
  const Stillness& stillness() const { return stillness_; }

 private:
  void compare(const ImageFeatures& features, const OdometryRotation& odometry);
  CameraMotion beginAnew(const ImageFeatures& features);
  bool isFading(std::size_t features) const;
  void refer(const ImageFeatures& features);
  void followRotation(std::int64_t stamp_ns);

  ReferenceImage reference_;
  Stillness stillness_;
  std::int64_t still_since_ns_ = 0;
  std::int64_t seen_still_ns_ = 0;
  double still_s_ = 0;
  bool is_reference_ = false;
  // The camera's turn since it came to rest, at the reference and when its rate was last looked at.
  Eigen::Matrix3d R_rest_reference_ = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d R_rest_before_ = Eigen::Matrix3d::Identity();
  std::int64_t before_ns_ = 0;
  bool is_rotating_ = false;
};

}  // namespace ardrone_vslam
