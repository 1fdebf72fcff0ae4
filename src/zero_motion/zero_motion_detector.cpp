// SPDX-License-Identifier: BSD-3-Clause
#include "zero_motion/zero_motion_detector.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "ardrone_vslam/rotation.hpp"
#include "matching/hamming.hpp"

namespace ardrone_vslam {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

constexpr std::size_t kFewestTracks = 15;
constexpr double kInlierSigmas = 3;   // of a corner's jump in the plane: 99 %
constexpr double kInlierShare = 0.6;  // a third of the tracks may be wrong
constexpr double kAttitudeSigmas = 3.5;
constexpr double kRounding_rad = 1e-6;  // of bearings in single precision
constexpr double kShiftGate = 16;       // chi-square with three degrees of freedom: 99.9 %
// Jumps of neighbouring corners are alike (compression, interpolation): more tracks than this say
// no more.
constexpr double kIndependentTracks = 20;
// A drone that turns round in its path is still for less than this.
constexpr double kAfter_s = 1;
constexpr double kRotating_deg_per_s = 3;  // a resting camera turns slower
constexpr double kTurnWindow_s = 0.5;
constexpr double kPatience_s = 0.2;   // single images are bad: a compressed stream's key frames
constexpr int kSameCorner_bits = 90;  // descriptors of one corner at rest

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double seconds(std::int64_t duration_ns) {
  return static_cast<double>(duration_ns) * 1e-9;
}

}  // namespace

CameraMotion ZeroMotionDetector::see(const ImageFeatures& features,
                                     const Eigen::Matrix3d& R_reference_now,
                                     double attitude_sigma_rad) {
  is_reference_ = false;
  pairUp(features);
  const auto medianLeft = [this](const Eigen::Matrix3d& R) {
    std::vector<double> left_rad;
    left_rad.reserve(pairs_.size());
    for (const Pair& pair : pairs_) left_rad.push_back((R * pair.now - pair.reference).norm());
    return left_rad.empty() ? 0 : median(left_rad);
  };
  const double left_rad = medianLeft(R_reference_now);
  // Half of the tracks are further off than a turn that is the odometry's within its deviation,
  // and a corner's jump, could bring them: whatever turn they agree on, the camera moves.
  const double farthest_rad = kInlierSigmas * kCornerJump_px / features.focal_length_px +
                              kAttitudeSigmas * attitude_sigma_rad;
  const bool surely_moves =
      still_s_ == 0 && pairs_.size() >= kFewestTracks && left_rad > farthest_rad + kRounding_rad;
  // The turn that the last image showed is a better guess while the camera rests, the odometry's
  // while it turns.
  if (!surely_moves && left_rad < medianLeft(stillness_.R_reference_now))
    stillness_.R_reference_now = R_reference_now;
  // Much of it is gone: what is there again has lost its tracks only.
  if (still_s_ > 0 && 2 * pairs_.size() < std::min(reference_.size(), features.size())) {
    findAgain(features, stillness_.R_reference_now);
    pairUp(features);
  }
  if (surely_moves) {
    stillness_ = {};
    stillness_.enough_tracks = true;
    stillness_.common = static_cast<int>(pairs_.size());
  } else {
    stillness_ = compare(R_reference_now, attitude_sigma_rad, features.focal_length_px);
  }
  if (!stillness_.is_still) {
    if (still_s_ > 0 && seconds(features.stamp_ns - seen_still_ns_) < kPatience_s)
      return CameraMotion::kUnknown;
    const bool was_seen = stillness_.enough_tracks;
    refer(features);
    still_since_ns_ = features.stamp_ns;
    still_s_ = 0;
    R_rest_reference_.setIdentity();
    R_rest_before_.setIdentity();
    before_ns_ = features.stamp_ns;
    is_turning_ = false;
    return was_seen ? CameraMotion::kMoving : CameraMotion::kUnknown;
  }
  seen_still_ns_ = features.stamp_ns;
  still_s_ = seconds(features.stamp_ns - still_since_ns_);
  followTurn(features.stamp_ns);
  // Until it rests the first reference stays while it can: what passes meanwhile is taken back
  // then.
  const bool is_fading = still_s_ < kAfter_s
                             ? pairs_.size() < kFewestTracks + 5
                             : 3 * pairs_.size() < std::min(reference_.size(), features.size()) ||
                                   2 * reference_.size() < features.size();
  if (is_fading) {
    R_rest_reference_ = R_rest_reference_ * stillness_.R_reference_now;
    refer(features);
  }
  if (still_s_ < kAfter_s) return CameraMotion::kUnknown;
  return is_turning_ ? CameraMotion::kRotating : CameraMotion::kResting;
}

void ZeroMotionDetector::refer(const ImageFeatures& features) {
  is_reference_ = true;
  stillness_.R_reference_now.setIdentity();
  reference_.clear();
  order_.reset(features);
  for (const TrackedFeature& one : order_) {
    reference_.push_back({one.track_id, features.bearing_cam[one.feature].cast<double>(),
                          features.descriptor[one.feature]});
  }
}

void ZeroMotionDetector::pairUp(const ImageFeatures& features) {
  pairs_.clear();
  for (std::size_t i = 0; i < features.size(); ++i) {
    const auto corner = std::lower_bound(
        reference_.begin(), reference_.end(), features.track_id[i],
        [](const Corner& c, std::uint32_t track_id) { return c.track_id < track_id; });
    if (corner == reference_.end() || corner->track_id != features.track_id[i]) continue;
    pairs_.push_back({corner->bearing, features.bearing_cam[i].cast<double>()});
  }
}

void ZeroMotionDetector::findAgain(const ImageFeatures& features,
                                   const Eigen::Matrix3d& R_reference_now) {
  std::vector<std::size_t> lost(reference_.size());
  std::iota(lost.begin(), lost.end(), std::size_t{0});
  const auto isThere = [&](std::size_t corner) {
    return std::find(features.track_id.begin(), features.track_id.end(),
                     reference_[corner].track_id) != features.track_id.end();
  };
  lost.erase(std::remove_if(lost.begin(), lost.end(), isThere), lost.end());
  const double reach_rad = 10 * kCornerJump_px / features.focal_length_px;
  const double nearest_cosine = std::cos(reach_rad);
  std::vector<Corner> found;
  for (std::size_t i = 0; i < features.size() && !lost.empty(); ++i) {
    const std::uint32_t id = features.track_id[i];
    const auto known = std::lower_bound(
        reference_.begin(), reference_.end(), id,
        [](const Corner& c, std::uint32_t track_id) { return c.track_id < track_id; });
    if (known != reference_.end() && known->track_id == id) continue;
    const Eigen::Vector3d bearing = R_reference_now * features.bearing_cam[i].cast<double>();
    int fewest = kSameCorner_bits;
    auto best = lost.end();
    for (auto corner = lost.begin(); corner != lost.end(); ++corner) {
      if (bearing.dot(reference_[*corner].bearing) < nearest_cosine) continue;
      const int bits = hammingDistance(features.descriptor[i], reference_[*corner].descriptor);
      if (bits >= fewest) continue;
      fewest = bits;
      best = corner;
    }
    if (best == lost.end()) continue;
    found.push_back({id, reference_[*best].bearing, reference_[*best].descriptor});
    lost.erase(best);
  }
  reference_.insert(reference_.end(), found.begin(), found.end());
  std::sort(reference_.begin(), reference_.end(),
            [](const Corner& a, const Corner& b) { return a.track_id < b.track_id; });
}

Stillness ZeroMotionDetector::compare(const Eigen::Matrix3d& R_reference_now,
                                      double attitude_sigma_rad, double focal_length_px) const {
  Stillness s;
  s.common = static_cast<int>(pairs_.size());
  s.enough_tracks = pairs_.size() >= kFewestTracks;
  if (!s.enough_tracks) return s;
  const double jump_rad = kCornerJump_px / focal_length_px;

  // The turn that most tracks agree on: weights fall with what is left (Geman and McClure), and
  // what counts as much left shrinks to the corners' own noise.
  Eigen::Matrix3d R = stillness_.R_reference_now;  // a guess so far
  std::vector<double> left_rad(pairs_.size());
  constexpr int kRounds = 8;
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t i = 0; i < pairs_.size(); ++i)
      left_rad[i] = (R * pairs_[i].now - pairs_[i].reference).norm();
    std::vector<double> sorted = left_rad;
    const double scale = std::max(2 * median(sorted), kInlierSigmas * jump_rad);
    Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
    Eigen::Vector3d g = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      const double off = left_rad[i] / scale;
      const double weight = 1 / ((1 + off * off) * (1 + off * off));
      const Eigen::Vector3d now = R * pairs_[i].now;
      A += weight * (Eigen::Matrix3d::Identity() - now * now.transpose());
      g += weight * now.cross(now - pairs_[i].reference);
    }
    R = rotationOf(-A.ldlt().solve(g)) * R;
  }
  if (!R.allFinite()) return s;
  s.R_reference_now = R;

  // Is there a shift left, the same turn being free to make up for it? Shift over depth.
  Matrix6d A = Matrix6d::Zero();  // turn, shift
  Vector6d g = Vector6d::Zero();
  int inliers = 0;
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const Eigen::Vector3d now = R * pairs_[i].now;
    const Eigen::Vector3d left = now - pairs_[i].reference;
    left_rad[i] = left.norm();
    if (left_rad[i] > kInlierSigmas * jump_rad) continue;
    ++inliers;
    Eigen::Matrix<double, 3, 6> J;
    J << -skew(now), now * now.transpose() - Eigen::Matrix3d::Identity();
    A += J.transpose() * J;
    g += J.transpose() * left;
  }
  s.inlier_share = static_cast<double>(inliers) / static_cast<double>(pairs_.size());
  s.median_px = median(left_rad) * focal_length_px;
  if (s.inlier_share < kInlierShare) return s;
  const double share = std::min(1.0, kIndependentTracks / inliers);
  A *= share / (jump_rad * jump_rad);
  g *= share / (jump_rad * jump_rad);
  const Eigen::Matrix3d A_turn = A.topLeftCorner<3, 3>();
  const Eigen::Matrix3d A_mixed = A.topRightCorner<3, 3>();
  const Eigen::Matrix3d A_shift = A.bottomRightCorner<3, 3>();
  const auto shiftGiven = [&](const Eigen::Matrix3d& turn) -> Eigen::Matrix3d {
    return A_shift - A_mixed.transpose() * turn.ldlt().solve(A_mixed);
  };
  // Keeps the shifts that a turn makes up for wholly from counting as seen.
  const Eigen::Matrix3d seen = shiftGiven(A_turn) + Eigen::Matrix3d::Identity();
  const Eigen::Vector3d g_shift =
      g.tail<3>() - A_mixed.transpose() * A_turn.ldlt().solve(g.head<3>());
  const double off_rad = Eigen::AngleAxisd(R * R_reference_now.transpose()).angle();
  s.is_still = g_shift.dot(seen.ldlt().solve(g_shift)) < kShiftGate &&
               off_rad < kAttitudeSigmas * attitude_sigma_rad;

  // A turn may stand for a shift by as much as it turned, or as little as the attitude is known.
  const double rotation_rad = std::min(Eigen::AngleAxisd(R).angle(), attitude_sigma_rad) + 1e-6;
  s.hidden =
      shiftGiven(A_turn + Eigen::Matrix3d::Identity() / (rotation_rad * rotation_rad)).inverse();
  return s;
}

void ZeroMotionDetector::followTurn(std::int64_t stamp_ns) {
  const double passed_s = seconds(stamp_ns - before_ns_);
  if (passed_s < kTurnWindow_s) return;
  const Eigen::Matrix3d R_rest_now = R_rest_reference_ * stillness_.R_reference_now;
  const double turned_rad = Eigen::AngleAxisd(R_rest_before_.transpose() * R_rest_now).angle();
  is_turning_ = turned_rad > kRotating_deg_per_s * M_PI / 180 * passed_s;
  R_rest_before_ = R_rest_now;
  before_ns_ = stamp_ns;
}

}  // namespace ardrone_vslam
