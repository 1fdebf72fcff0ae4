// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "ardrone_vslam/setup_watch.hpp"
#include "odometry/image_rotation.hpp"

namespace ardrone_vslam {

/// The camera's motion between two images by the odometry and the extrinsics that are told.
struct ToldMotion {
  Eigen::Matrix3d R_then_now = Eigen::Matrix3d::Identity();
  Eigen::Vector3d displacement_then_m = Eigen::Vector3d::Zero();  ///< axes of the image then
};

/// Offsets of the images' stamps that are compared; the one in the middle is what is told.
constexpr std::size_t kSetupOffsets = 21;
constexpr std::size_t kNoOffset = kSetupOffsets / 2;
constexpr std::int64_t kSetupOffsetStep_ns = 40'000'000;
/// The calibration's focal length over the true one.
constexpr std::array<double, 8> kFocalFactors{0.5, 0.6, 0.7, 0.8, 1.25, 1.5, 1.75, 2.0};

/// One pair of images: its motion as seen, and as told.
struct ComparedMotion {
  double span_s = 0;
  ImageMotion seen;
  SeenYaw yaw;
  double squares_told = 0;  ///< squaresBetween() it and what is told, as far as the tracks bear out
  /// As seen if the focal length were wrong by each factor; empty: was not looked at.
  std::array<std::optional<ImageMotion>, kFocalFactors.size()> seen_at_factor;
  double pairs = 0;  ///< tracks in both images
  std::array<ToldMotion, kSetupOffsets> told_at_offset;
  ToldMotion told_by_position;  ///< if the odometry integrates with a mirrored yaw
  ToldMotion told_by_yaw;       ///< if its yaw is mirrored

  const ToldMotion& told() const { return told_at_offset[kNoOffset]; }
};

/// Squared deviations between what is seen and what is told, of 5 that are independent; at most
/// kMostSquares. The image's share is what its fit claims; the odometry's is 0.3 degrees and a
/// twentieth of the turn, and of the direction 6 degrees and 0.4 m/s over the speed. Below 0.6 m/s
/// the odometry tells no direction: its bias alone may be that large.
double squaresBetween(const ImageMotion& seen, const ToldMotion& told, double span_s);
constexpr double kMostSquares = 30;

/// The motion that the tracks show. Where several explain them as well (a plane's picture has two)
/// it is the one nearest to what is told.
/// @return nothing where too few tracks agree
std::optional<ImageMotion> motionSeen(const std::vector<BearingPair>& pairs,
                                      double corner_sigma_rad, const ToldMotion& told,
                                      double span_s);

/// squaresBetween(), but no more than squaresAgainst() what is told: that it is wrong must be seen
/// in the tracks, not only in what their fit claims.
double squaresTold(const std::vector<BearingPair>& pairs, double corner_sigma_rad,
                   const ImageMotion& seen, const ToldMotion& told, double span_s);

/// By how much the odometry's yaw is off, of a motion that was seen and told.
/// @return of no span where the images tell no turn about base's z
SeenYaw seenYaw(const ComparedMotion& motion, const Eigen::Matrix3d& R_base_cam,
                std::int64_t stamp_ns);

/// As motionSeen(), if the focal length were wrong by a factor; only near what is told.
/// @param pairs  changed
std::optional<ImageMotion> motionAtFactor(std::vector<BearingPair>& pairs, double corner_sigma_rad,
                                          const ToldMotion& told, double span_s, double factor);

}  // namespace ardrone_vslam
