// SPDX-License-Identifier: BSD-3-Clause
#include "mapper/time_offset_watch.hpp"

namespace ardrone_vslam {

void TimeOffsetWatch::useCamera(const Eigen::Isometry3d& T_base_cam) {
  if (estimator_) {
    estimator_->useCamera(T_base_cam);
  } else {
    estimator_.emplace(T_base_cam, used_s_);
  }
}

void TimeOffsetWatch::see(const ImageFeatures& features, const OdometryBuffer& odometries) {
  estimator_->see(features, odometries);
  if (is_told_) return;
  const std::string advice = adviceOn(estimator_->estimate(), used_s_);
  is_told_ = !advice.empty();
  if (is_told_) warnings_.say(advice);
}

void TimeOffsetWatch::fill(Status& status) const {
  toStatus(estimator_ ? estimator_->estimate() : TimeOffset{}, used_s_, status);
}

void TimeOffsetWatch::diagnose(diagnostic_updater::DiagnosticStatusWrapper& wrapper) const {
  if (!estimator_) return;
  const TimeOffset& offset = estimator_->estimate();
  if (offset.state == TimeOffsetState::kKnown) {
    wrapper.add("image time offset [s], estimated", offset.offset_s);
    wrapper.add("its deviation [s]", offset.deviation_s);
  } else {
    wrapper.add("image time offset [s], estimated", explain(offset.state));
  }
  const std::string advice = adviceOn(offset, used_s_);
  if (!advice.empty()) wrapper.add("image time offset", advice);
}

}  // namespace ardrone_vslam
