// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "ardrone_vslam/setup_monitor.hpp"
#include "linear/scalars.hpp"

namespace ardrone_vslam {
namespace {

// Of the time between two images, how much the offset may change: the shorter the way to it, the
// fewer images are taken for neither.
constexpr double kShare = 0.9;

}  // namespace

ImageClock::ImageClock(const NumberOrAuto& told_s)
    : told_s_(told_s),
      offset_ns_(std::llround(told_s.value_or(0) * 1e9)),
      lagging_ns_(offset_ns_),
      left_ns_(offset_ns_) {}

void ImageClock::useCamera(const Eigen::Isometry3d& T_base_cam) {
  if (estimator_) {
    estimator_->useCamera(T_base_cam);
  } else {
    estimator_.emplace(T_base_cam, used_s());
  }
}

std::int64_t ImageClock::exposed_ns(std::int64_t stamp_ns) const {
  if (newest_ns_ == 0 || stamp_ns <= newest_ns_) return stamp_ns + offset_ns_;
  const auto most_ns = std::llround(kShare * static_cast<double>(stamp_ns - newest_ns_));
  return stamp_ns + lagging_ns_ +
         std::clamp<std::int64_t>(offset_ns_ - lagging_ns_, -most_ns, most_ns);
}

double ImageClock::see(const ImageFeatures& features, const OdometryBuffer& odometry,
                       SetupFault fault) {
  lagging_ns_ = exposed_ns(features.stamp_ns) - features.stamp_ns;
  newest_ns_ = features.stamp_ns;
  double change_s = 0;
  if (lagging_ns_ == offset_ns_) {
    change_s = seconds(offset_ns_ - left_ns_);
    left_ns_ = offset_ns_;
  }
  estimator_->see(features, odometry);
  const bool may_change =
      !told_s_ && (fault == SetupFault::kNone || fault == SetupFault::kTimeOffset);
  if (may_change && isOther(estimator_->estimate(), used_s()))
    offset_ns_ = std::llround(estimator_->estimate().offset_s * 1e9);
  return change_s;
}

TimeOffset ImageClock::estimate() const {
  return estimator_ ? estimator_->estimate() : TimeOffset{};
}

}  // namespace ardrone_vslam
