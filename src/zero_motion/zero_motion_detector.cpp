// SPDX-License-Identifier: BSD-3-Clause
#include "zero_motion/zero_motion_detector.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "ardrone_vslam/rotation.hpp"
#include "linear/scalars.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kRounding_rad = 1e-6;  // of bearings in single precision
// A drone that turns round in its path is still for less than this.
constexpr double kAfter_s = 1;
constexpr double kRotating_deg_per_s = 3;  // a resting camera turns slower
constexpr double kRotationWindow_s = 0.5;
constexpr double kPatience_s = 0.2;  // single images are bad: a compressed stream's key frames

// Half of the tracks are further off than a turn that is the odometry's within its sigma, and a
// corner's jump, could bring them: whatever turn they agree on, the camera moves.
bool isBeyondAnyRotation(double left_rad, const OdometryRotation& odometry,
                         double focal_length_px) {
  const double farthest_rad =
      kInlierSigmas * kCornerJump_px / focal_length_px + kRotationSigmas * odometry.sigma_rad;
  return left_rad > farthest_rad + kRounding_rad;
}

}  // namespace

CameraMotion ZeroMotionDetector::see(const ImageFeatures& features,
                                     const OdometryRotation& odometry) {
  is_reference_ = false;
  compare(features, odometry);
  if (!stillness_.is_still) {
    if (still_s_ > 0 && seconds(features.stamp_ns - seen_still_ns_) < kPatience_s)
      return CameraMotion::kUnknown;
    return beginAnew(features);
  }
  seen_still_ns_ = features.stamp_ns;
  still_s_ = seconds(features.stamp_ns - still_since_ns_);
  followRotation(features.stamp_ns);
  if (isFading(features.size())) {
    R_rest_reference_ = R_rest_reference_ * stillness_.R_reference_now;
    refer(features);
  }
  if (still_s_ < kAfter_s) return CameraMotion::kUnknown;
  return is_rotating_ ? CameraMotion::kRotating : CameraMotion::kResting;
}

void ZeroMotionDetector::compare(const ImageFeatures& features, const OdometryRotation& odometry) {
  std::vector<BearingPair> pairs = reference_.pairsWith(features);
  const double left_rad = medianLeft_rad(pairs, odometry.R_reference_now);
  if (still_s_ == 0 && pairs.size() >= kFewestPairs &&
      isBeyondAnyRotation(left_rad, odometry, features.focal_length_px)) {
    stillness_ = {};
    stillness_.enough_tracks = true;
    stillness_.common = static_cast<int>(pairs.size());
    return;
  }
  // The turn that the last image showed is a better guess while the camera rests, the odometry's
  // while it turns.
  const Eigen::Matrix3d R_guess = left_rad < medianLeft_rad(pairs, stillness_.R_reference_now)
                                      ? odometry.R_reference_now
                                      : stillness_.R_reference_now;
  // Much of it is gone: what is there again has lost its tracks only.
  if (still_s_ > 0 && 2 * pairs.size() < std::min(reference_.size(), features.size())) {
    reference_.findAgain(features, R_guess);
    pairs = reference_.pairsWith(features);
  }
  stillness_ = stillnessOf(pairs, odometry, R_guess, features.focal_length_px);
}

CameraMotion ZeroMotionDetector::beginAnew(const ImageFeatures& features) {
  const bool was_seen = stillness_.enough_tracks;
  refer(features);
  still_since_ns_ = features.stamp_ns;
  still_s_ = 0;
  R_rest_reference_.setIdentity();
  R_rest_before_.setIdentity();
  before_ns_ = features.stamp_ns;
  is_rotating_ = false;
  return was_seen ? CameraMotion::kMoving : CameraMotion::kUnknown;
}

// Until it rests the first reference stays while it can: what passes meanwhile is taken back then.
bool ZeroMotionDetector::isFading(std::size_t features) const {
  const auto common = static_cast<std::size_t>(stillness_.common);
  if (still_s_ < kAfter_s) return common < kFewestPairs + 5;
  return 3 * common < std::min(reference_.size(), features) || 2 * reference_.size() < features;
}

void ZeroMotionDetector::refer(const ImageFeatures& features) {
  is_reference_ = true;
  stillness_.R_reference_now.setIdentity();
  reference_.take(features);
}

void ZeroMotionDetector::followRotation(std::int64_t stamp_ns) {
  const double passed_s = seconds(stamp_ns - before_ns_);
  if (passed_s < kRotationWindow_s) return;
  const Eigen::Matrix3d R_rest_now = R_rest_reference_ * stillness_.R_reference_now;
  const double rotation_rad = angleOf_rad(R_rest_before_.transpose() * R_rest_now);
  is_rotating_ = rotation_rad > kRotating_deg_per_s * M_PI / 180 * passed_s;
  R_rest_before_ = R_rest_now;
  before_ns_ = stamp_ns;
}

}  // namespace ardrone_vslam
