// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/setup_watch.hpp"

#include <algorithm>
#include <cmath>

#include "ardrone_vslam/rotation.hpp"
#include "linear/median.hpp"
#include "linear/scalars.hpp"
#include "odometry/image_rays.hpp"
#include "setup/setup_hypotheses.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::int64_t kStep_ns = 60'000'000;        // from one image kept to the next
constexpr std::int64_t kBetween_ns = 150'000'000;    // from one comparison to the next
constexpr std::int64_t kSpan_ns = 270'000'000;       // a pair's images are so far apart, or less;
constexpr std::int64_t kLongest_ns = 1'500'000'000;  // slow cameras' so far
constexpr std::size_t kImages = 16;                  // kept: those of kSpan_ns and of the offsets
constexpr double kLeast_px = 3;  // motion seen or told, four of kCornerSigma_px: less is noise
constexpr double kStill = 1e-6;  // odometry that moves less, in m and rad, is frozen

std::int64_t offsetOf_ns(std::size_t offset) {
  return (static_cast<std::int64_t>(offset) - static_cast<std::int64_t>(kNoOffset)) *
         kSetupOffsetStep_ns;
}

Eigen::Matrix3d yawed(double yaw_rad) {
  return rotationOf(Eigen::Vector3d(0, 0, yaw_rad));
}

Eigen::Isometry3d withMirroredYaw(Eigen::Isometry3d T_odom_base) {
  T_odom_base.linear() = yawed(-2 * yawOf(T_odom_base.linear())) * T_odom_base.linear();
  return T_odom_base;
}

/// The pose now, if its way had been integrated with the mirrored yaw.
Eigen::Isometry3d withMirroredPosition(const Eigen::Isometry3d& T_odom_then,
                                       Eigen::Isometry3d T_odom_now) {
  const Eigen::Vector3d displacement_odom_m = T_odom_now.translation() - T_odom_then.translation();
  T_odom_now.translation() =
      T_odom_then.translation() + yawed(2 * yawOf(T_odom_then.linear())) * displacement_odom_m;
  return T_odom_now;
}

}  // namespace

/// What SetupWatch does and remembers.
class SetupWatch::State {
 public:
  State(const Eigen::Isometry3d& T_base_cam, double image_time_offset_s)
      : T_base_cam_(T_base_cam),
        image_time_offset_s_(image_time_offset_s),
        hypotheses_(T_base_cam, image_time_offset_s) {}

  void see(const ImageFeatures& features, const OdometryBuffer& odometry);
  const SetupFinding& finding() const { return hypotheses_.finding(); }

 private:
  ImageRays& image(std::size_t number) { return images_[number % kImages]; }
  void compare(const ImageRays& now, std::size_t number, const OdometryBuffer& odometry);
  void compare(const ImageRays& then, const ImageRays& now, const OdometryBuffer& odometry);
  double medianMotion_rad();
  bool find(const OdometryBuffer& odometry, const ImageRays& then, const ImageRays& now,
            ComparedMotion& motion) const;
  ToldMotion motionOf(const Eigen::Isometry3d& then, const Eigen::Isometry3d& now) const;

  Eigen::Isometry3d T_base_cam_;
  double image_time_offset_s_;
  std::array<ImageRays, kImages> images_;
  std::size_t taken_ = 0;         // images so far
  std::size_t used_ = 0;          // of these, oldest first, are done with
  std::int64_t compared_ns_ = 0;  // stamp of the last image that was
  TrackOrder order_;
  std::vector<BearingPair> pairs_;
  std::vector<double> moved_;
  SetupHypotheses hypotheses_;
};

void SetupWatch::State::see(const ImageFeatures& features, const OdometryBuffer& odometry) {
  if (taken_ > 0 && features.stamp_ns < image(taken_ - 1).stamp_ns) taken_ = used_ = 0;
  if (taken_ == 0 || features.stamp_ns - image(taken_ - 1).stamp_ns >= kStep_ns) {
    image(taken_).take(features, order_);
    ++taken_;
    used_ = std::max(used_, taken_ - std::min(taken_, kImages / 2));
  }
  // The odometry reaches to the newest image, at all offsets of the older ones, then.
  constexpr std::int64_t kReach_ns = kNoOffset * kSetupOffsetStep_ns;
  for (; used_ < taken_ && image(used_).stamp_ns + kReach_ns <= features.stamp_ns; ++used_) {
    const ImageRays& now = image(used_);
    const bool is_due = now.stamp_ns < compared_ns_ || now.stamp_ns - compared_ns_ >= kBetween_ns;
    if (is_due) compare(now, used_, odometry);
  }
}

/// With the oldest image that is near enough and has enough tracks in common.
void SetupWatch::State::compare(const ImageRays& now, std::size_t number,
                                const OdometryBuffer& odometry) {
  const std::size_t oldest = number - std::min(number, kImages / 2 - 1);
  for (std::size_t i = oldest; i < number; ++i) {
    const ImageRays& then = image(i);
    const std::int64_t span_ns = now.stamp_ns - then.stamp_ns;
    const bool is_last = i + 1 == number;
    if (span_ns > (is_last ? kLongest_ns : kSpan_ns)) continue;
    findPairs(then, now, pairs_);
    if (pairs_.size() < kFewestRotationTracks) continue;
    compared_ns_ = now.stamp_ns;
    return compare(then, now, odometry);
  }
}

void SetupWatch::State::compare(const ImageRays& then, const ImageRays& now,
                                const OdometryBuffer& odometry) {
  ComparedMotion motion;
  motion.span_s = seconds(now.stamp_ns - then.stamp_ns);
  motion.pairs = static_cast<double>(pairs_.size());
  if (!find(odometry, then, now, motion)) return;
  const ToldMotion& told = motion.told();
  // Tracks that stay where they are contradict a turn that is told: the same image again and again.
  const double told_rad = rotationVectorOf(told.R_then_now).norm();
  const double motion_rad = std::max(medianMotion_rad(), told_rad);
  if (motion_rad * now.focal_length_px < kLeast_px) return;
  const double sigma_rad = kCornerSigma_px / now.focal_length_px;
  const auto seen = motionSeen(pairs_, sigma_rad, told, motion.span_s);
  if (!seen) return;
  motion.seen = *seen;
  motion.yaw = seenYaw(motion, T_base_cam_.linear(), now.stamp_ns);
  motion.squares_told = squaresTold(pairs_, sigma_rad, *seen, told, motion.span_s);
  if (hypotheses_.wantsFactors()) {
    double factor = 1;
    for (std::size_t i = 0; i < kFocalFactors.size(); ++i) {
      // The calibration's length over the true one: rays are to be that much further apart.
      motion.seen_at_factor[i] = motionAtFactor(pairs_, sigma_rad * factor, told, motion.span_s,
                                                kFocalFactors[i] / factor);
      factor = kFocalFactors[i];
    }
  }
  hypotheses_.add(motion);
}

double SetupWatch::State::medianMotion_rad() {
  moved_.clear();
  for (const BearingPair& pair : pairs_) moved_.push_back((pair.now - pair.then).norm());
  return medianOf(moved_);
}

ToldMotion SetupWatch::State::motionOf(const Eigen::Isometry3d& then,
                                       const Eigen::Isometry3d& now) const {
  const Eigen::Isometry3d T_then_now = (then * T_base_cam_).inverse() * now * T_base_cam_;
  return {T_then_now.linear(), T_then_now.translation()};
}

/// @return false where odometry is missing, or frozen: that is no fault of the set-up
bool SetupWatch::State::find(const OdometryBuffer& odometry, const ImageRays& then,
                             const ImageRays& now, ComparedMotion& motion) const {
  OdometryState before, after;
  const std::int64_t used_ns = std::llround(image_time_offset_s_ * 1e9);
  const auto findAt = [&](std::int64_t offset_ns) {
    return odometry.at(then.stamp_ns + offset_ns, before) == OdometryBuffer::Lookup::kFound &&
           odometry.at(now.stamp_ns + offset_ns, after) == OdometryBuffer::Lookup::kFound &&
           before.start == after.start;
  };
  if (!findAt(used_ns)) return false;
  const Eigen::Isometry3d T_then = before.T_odom_base, T_now = after.T_odom_base;
  const ToldMotion told = motionOf(T_then, T_now);
  motion.told_by_position = motionOf(T_then, withMirroredPosition(T_then, T_now));
  motion.told_by_yaw = motionOf(withMirroredYaw(T_then), withMirroredYaw(T_now));
  for (std::size_t i = 0; i < kSetupOffsets; ++i) {
    // Where it begins or has a gap an offset says what none does.
    const bool is_found = findAt(used_ns + offsetOf_ns(i));
    motion.told_at_offset[i] = is_found ? motionOf(before.T_odom_base, after.T_odom_base) : told;
  }
  return told.displacement_then_m.norm() > kStill ||
         rotationVectorOf(told.R_then_now).norm() > kStill;
}

SetupWatch::SetupWatch(const Eigen::Isometry3d& T_base_cam, double image_time_offset_s)
    : state_(std::make_unique<State>(T_base_cam, image_time_offset_s)) {}
SetupWatch::~SetupWatch() = default;
SetupWatch::SetupWatch(SetupWatch&& other) noexcept = default;
SetupWatch& SetupWatch::operator=(SetupWatch&& other) noexcept = default;

void SetupWatch::see(const ImageFeatures& features, const OdometryBuffer& odometry) {
  state_->see(features, odometry);
}

const SetupFinding& SetupWatch::finding() const {
  return state_->finding();
}

}  // namespace ardrone_vslam
