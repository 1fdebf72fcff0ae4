// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "ardrone_vslam/features.hpp"
#include "window/track_order.hpp"

namespace ardrone_vslam {

/// How far a corner at rest jumps between two images, per axis: noise, and the corner's own pixel.
constexpr double kCornerJump_px = 0.8;

/// What the image alone says of the camera's motion.
enum class CameraMotion {
  kUnknown,   ///< too few tracks, or not still for long enough
  kMoving,    ///< it shifts, or turns otherwise than the odometry does
  kResting,   ///< still
  kRotating,  ///< turning on the spot
};

/// An image beside the reference.
struct Stillness {
  bool enough_tracks = false;  ///< to tell anything of it
  bool is_still = false;       ///< one turn, within the odometry's, explains how the image moved
  int common = 0;              ///< tracks that both have
  double inlier_share = 0;     ///< of these, those that one turn explains
  double median_px = 0;        ///< of the tracks' motion once the turn is taken out
  Eigen::Matrix3d R_reference_now = Eigen::Matrix3d::Identity();  ///< by the tracks
  /// Covariance of the way that the images may hide, over the scene's depth; axes of the
  /// reference's camera. Largest along the view, and across where a turn may have made up for it.
  Eigen::Matrix3d hidden = Eigen::Matrix3d::Zero();
};

/// Tells a camera that rests or turns on the spot from one that moves: compares each image with a
/// reference that stays while nothing moves, so that creeping is seen. Tracks that break are found
/// again in the reference by their descriptors.
class ZeroMotionDetector {
 public:
  /// @param R_reference_now  the camera's turn since the reference by the odometry
  /// @param attitude_sigma_rad  of that, per axis
  CameraMotion see(const ImageFeatures& features, const Eigen::Matrix3d& R_reference_now,
                   double attitude_sigma_rad);

  /// Whether the image seen last became the reference: there was none, it moved, or the old one has
  /// too little in common with it (the motion then goes on).
  bool isReference() const { return is_reference_; }
  /// Since when it has been still [s].
  double still_s() const { return still_s_; }
  /// Of the image seen last.
  const Stillness& stillness() const { return stillness_; }

 private:
  struct Corner {
    std::uint32_t track_id;
    Eigen::Vector3d bearing;
    Descriptor descriptor;
  };
  struct Pair {
    Eigen::Vector3d reference;
    Eigen::Vector3d now;
  };

  void refer(const ImageFeatures& features);
  void pairUp(const ImageFeatures& features);
  void findAgain(const ImageFeatures& features, const Eigen::Matrix3d& R_reference_now);
  Stillness compare(const Eigen::Matrix3d& R_reference_now, double attitude_sigma_rad,
                    double focal_length_px) const;
  void followTurn(std::int64_t stamp_ns);

  TrackOrder order_;               // of the newest reference's features
  std::vector<Corner> reference_;  // ascending in track id
  std::vector<Pair> pairs_;
  Stillness stillness_;
  std::int64_t still_since_ns_ = 0;
  std::int64_t seen_still_ns_ = 0;
  double still_s_ = 0;
  bool is_reference_ = false;
  // The camera's turn since it came to rest, at the reference and when its rate was last looked at.
  Eigen::Matrix3d R_rest_reference_ = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d R_rest_before_ = Eigen::Matrix3d::Identity();
  std::int64_t before_ns_ = 0;
  bool is_turning_ = false;
};

}  // namespace ardrone_vslam
