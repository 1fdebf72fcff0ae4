// SPDX-License-Identifier: BSD-3-Clause
#include "setup/setup_hypotheses.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ardrone_vslam/rotation.hpp"
#include "linear/portable_math.hpp"
#include "linear/scalars.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kMemory = 60;  // motions after which a sum has forgotten all but a third
// Most squares by which a sum and that of what is told may differ: faults can begin and end.
constexpr double kSaturated = 100;
/// Squares by which a fault must explain more than the set-up as told, and so many times better.
/// In right set-ups the difference stays below 15.
constexpr double kFault = 40;
constexpr double kTimesBetter = 2;
constexpr double kClear = 15;  // squares by which one cause must explain more than another
constexpr double kOver = 20;   // squares by which the told one must explain more, to end a fault
constexpr double kNothingFits = 14;  // squares of a motion, mean: no known fault has to explain it
constexpr double kFitsAgain = 6;     // and to end that
constexpr double kFewest = 10;       // motions for that
constexpr double kSuspicious = 1.0;  // mean squares; usual is about 0.6
constexpr std::size_t kSameClock = 4;      // offset steps that are no fault
constexpr double kIndependentTracks = 40;  // outliers of neighbouring corners are alike

std::size_t stepsFromMiddle(std::size_t offset) {
  return offset > kNoOffset ? offset - kNoOffset : kNoOffset - offset;
}

double offsetOf_s(std::size_t offset) {
  return (static_cast<double>(offset) - static_cast<double>(kNoOffset)) *
         seconds(kSetupOffsetStep_ns);
}

ToldMotion rotated(const Eigen::Matrix3d& Q, const ToldMotion& told) {
  return {Q.transpose() * told.R_then_now * Q, Q.transpose() * told.displacement_then_m};
}

}  // namespace

SetupHypotheses::SetupHypotheses(const Eigen::Isometry3d& T_base_cam, double image_time_offset_s)
    : T_base_cam_(T_base_cam), image_time_offset_s_(image_time_offset_s) {
  for (std::size_t i = 0; i < kSetupOffsets; ++i) {
    const bool is_same = stepsFromMiddle(i) <= kSameClock;
    hypotheses_.push_back({is_same ? SetupFault::kNone : SetupFault::kTimeOffset, i});
  }
  for (const Eigen::Matrix3d& Q : quarterTurns())
    if (!Q.isIdentity()) hypotheses_.push_back({SetupFault::kExtrinsics, 0, Q});
  for (const Eigen::Vector3d& mirror : {Eigen::Vector3d(-1, 1, 1), Eigen::Vector3d(1, -1, 1)})
    hypotheses_.push_back({SetupFault::kMirrored, 0, mirror.asDiagonal()});
  for (std::size_t i = 0; i < kFocalFactors.size(); ++i)
    hypotheses_.push_back({SetupFault::kFocalLength, i});
  hypotheses_.push_back({SetupFault::kOdometryPosition});
  hypotheses_.push_back({SetupFault::kOdometryYaw});
  hypotheses_.push_back({SetupFault::kStillImages});
}

double SetupHypotheses::squaresOf(const Hypothesis& h, const ComparedMotion& motion) {
  const ToldMotion& told = motion.told();
  switch (h.fault) {
    case SetupFault::kExtrinsics:
    case SetupFault::kMirrored:
      return squaresBetween(motion.seen, rotated(h.Q, told), motion.span_s);
    case SetupFault::kFocalLength: {
      const auto& seen = motion.seen_at_factor[h.which];
      if (!seen) return kMostSquares;
      // Tracks must fit each other as well as before.
      const double worse = std::max(0.0, seen->cost - motion.seen.cost) *
                           std::min(1.0, kIndependentTracks / motion.pairs);
      return std::min(kMostSquares, worse + squaresBetween(*seen, told, motion.span_s));
    }
    case SetupFault::kOdometryPosition:
      return squaresBetween(motion.seen, motion.told_by_position, motion.span_s);
    case SetupFault::kOdometryYaw:
      return squaresBetween(motion.seen, motion.told_by_yaw, motion.span_s);
    case SetupFault::kStillImages:
      return squaresBetween(motion.seen, {}, motion.span_s);
    case SetupFault::kNone:
    case SetupFault::kTimeOffset:
    case SetupFault::kUnknown:
      break;
  }
  if (h.fault == SetupFault::kNone && h.which == kNoOffset) return motion.squares_told;
  return squaresBetween(motion.seen, motion.told_at_offset[h.which], motion.span_s);
}

void SetupHypotheses::add(const ComparedMotion& motion) {
  static const double kKept = portable::exp(-1 / kMemory);
  const bool has_factors = wantsFactors();
  motions_ = kKept * motions_ + 1;
  for (Hypothesis& h : hypotheses_) {
    const bool is_unseen = h.fault == SetupFault::kFocalLength && !has_factors;
    h.squares = kKept * h.squares + (is_unseen ? motion.squares_told : squaresOf(h, motion));
  }
  judge();
  finding_.yaw = motion.yaw;
}

bool SetupHypotheses::wantsFactors() const {
  return bestWith(false).squares > kSuspicious * motions_;
}

const SetupHypotheses::Hypothesis& SetupHypotheses::bestWith(bool fault) const {
  const Hypothesis* best = nullptr;
  for (const Hypothesis& h : hypotheses_) {
    if ((h.fault != SetupFault::kNone) != fault) continue;
    if (best == nullptr || h.squares < best->squares) best = &h;
  }
  return *best;
}

void SetupHypotheses::judge() {
  saturate();
  const double told = bestWith(false).squares;
  const Hypothesis& best = bestWith(true);
  const bool explains = told - best.squares > kFault && told > kTimesBetter * best.squares;
  const bool nothing_fits = motions_ > kFewest && told > kNothingFits * motions_;
  const bool is_over = finding_.fault == SetupFault::kUnknown ? told < kFitsAgain * motions_
                                                              : best.squares - told > kOver;
  if (explains) {
    name(best);
  } else if (finding_.fault == SetupFault::kNone && nothing_fits) {
    finding_ = {};
    finding_.fault = SetupFault::kUnknown;
  } else if (finding_.fault != SetupFault::kNone && is_over) {
    forget();
  } else if (finding_.fault == SetupFault::kNone) {
    finding_.is_confirmed = isConfirmed(told);
  }
}

void SetupHypotheses::saturate() {
  const double told = bestWith(false).squares;
  for (Hypothesis& h : hypotheses_) h.squares = std::min(h.squares, told + kSaturated);
  const double difference = told - bestWith(true).squares;
  if (difference <= kSaturated) return;
  const double share = kSaturated / difference;
  for (Hypothesis& h : hypotheses_) h.squares *= share;
  motions_ *= share;
}

bool SetupHypotheses::isConfirmed(double told) const {
  if (told > kFitsAgain * motions_) return false;
  const bool has_factors = wantsFactors();
  return std::all_of(hypotheses_.begin(), hypotheses_.end(), [&](const Hypothesis& h) {
    if (h.fault == SetupFault::kNone) return true;
    // The nearest focal lengths differ too little to be ruled out by more.
    if (h.fault == SetupFault::kFocalLength) return !has_factors || h.squares > told;
    return h.squares - told > kClear;
  });
}

void SetupHypotheses::forget() {
  for (Hypothesis& h : hypotheses_) h.squares = 0;
  motions_ = 0;
  finding_ = {};
}

void SetupHypotheses::name(const Hypothesis& best) {
  finding_ = {};
  finding_.fault = best.fault;
  finding_.T_base_cam = T_base_cam_;
  finding_.T_base_cam.linear() = T_base_cam_.linear() * best.Q;
  double rival = best.squares + kClear;
  for (const Hypothesis& h : hypotheses_) {
    const bool is_other =
        h.fault != best.fault || (h.fault == SetupFault::kExtrinsics && &h != &best);
    if (h.fault == SetupFault::kNone || !is_other || h.squares > rival) continue;
    rival = h.squares;
    finding_.rival = h.fault;
  }
  if (best.fault == SetupFault::kFocalLength) finding_.focal_factor = kFocalFactors[best.which];
  if (best.fault == SetupFault::kTimeOffset)
    finding_.offset_s = image_time_offset_s_ + offsetOf_s(best.which);
}

}  // namespace ardrone_vslam
