// SPDX-License-Identifier: BSD-3-Clause
#include "odometry_fusion/correction_queue.hpp"

#include <algorithm>
#include <utility>

#include "input_checks/checked.hpp"
#include "stamps/stamp_guard.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::size_t kMostWaiting = 1000;

}  // namespace

CorrectionQueue::CorrectionQueue(DelayedFusion& fusion, std::string odometry_topic, Refuse refuse)
    : fusion_(fusion), odometry_topic_(std::move(odometry_topic)), refuse_(std::move(refuse)) {}

void CorrectionQueue::add(const LateCorrection& correction) {
  const std::int64_t stamp_ns = correction.stamp_ns;
  if (!waiting_.empty() && waiting_.back().stamp_ns - stamp_ns >= StampGuard::kRestart_ns) {
    // The mapper began anew: what it said of a later time is void.
    while (!waiting_.empty() && waiting_.back().stamp_ns >= stamp_ns) waiting_.pop_back();
  }
  const auto later = std::upper_bound(
      waiting_.begin(), waiting_.end(), stamp_ns,
      [](std::int64_t stamp, const LateCorrection& waiting) { return stamp < waiting.stamp_ns; });
  waiting_.insert(later, correction);
  if (waiting_.size() > kMostWaiting) {
    waiting_.pop_front();
    refuse_("too many corrections wait for odometry at their stamps");
  }
}

bool CorrectionQueue::use() {
  bool is_used = false;
  while (!waiting_.empty()) {
    const LateCorrection& correction = waiting_.front();
    const DelayedFusion::Answer answer = fusion_.correct(correction);
    if (answer == DelayedFusion::Answer::kNotYet) break;
    if (answer == DelayedFusion::Answer::kUsed) {
      is_used = true;
      ++used_;
    } else {
      if (answer == DelayedFusion::Answer::kTooOld) ++too_old_;
      refuse_(explain(answer, correction));
    }
    waiting_.pop_front();
  }
  return is_used;
}

std::string CorrectionQueue::explain(DelayedFusion::Answer answer,
                                     const LateCorrection& correction) const {
  const double late_s = static_cast<double>(fusion_.newestStamp_ns() - correction.stamp_ns) * 1e-9;
  switch (answer) {
    case DelayedFusion::Answer::kTooOld:
      return text("its image is ", late_s,
                  " s older than the newest odometry, and the odometry of that time is not kept; "
                  "raise odometry_buffer_s, or let the mapper do less");
    case DelayedFusion::Answer::kGap:
      return text("the odometry has a hole longer than half a second at its stamp");
    case DelayedFusion::Answer::kNotAfter:
      return "its stamp is not after that of the correction in use";
    case DelayedFusion::Answer::kOtherOdometry:
      return text("its observer_pose is not where ", odometry_topic_,
                  " was at its stamp; remap odometry to the mapper's topic, and set odometry_mode "
                  "and odometry_height as the mapper's");
    case DelayedFusion::Answer::kBad:
      return faultOf(correction);
    case DelayedFusion::Answer::kUsed:
    case DelayedFusion::Answer::kNotYet:
      break;
  }
  return {};
}

}  // namespace ardrone_vslam
