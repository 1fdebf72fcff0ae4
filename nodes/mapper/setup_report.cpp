// SPDX-License-Identifier: BSD-3-Clause
#include "mapper/setup_report.hpp"

namespace ardrone_vslam {

void SetupReport::useCamera(const Eigen::Isometry3d& T_base_cam, const std::string& base,
                            const std::string& camera) {
  if (time_offset_) {
    time_offset_->useCamera(T_base_cam);
  } else {
    time_offset_.emplace(T_base_cam, used_s_);
  }
  setup_.emplace(T_base_cam, used_s_);
  base_ = base;
  camera_ = camera;
  fault_.clear();
}

void SetupReport::see(const ImageFeatures& features, const OdometryBuffer& odometries) {
  time_offset_->see(features, odometries);
  setup_->see(features, odometries);
  sayFault();
  if (is_offset_told_ || !fault_.empty()) return;
  const std::string advice = adviceOn(time_offset_->estimate(), used_s_);
  is_offset_told_ = !advice.empty();
  if (is_offset_told_) warnings_.say(advice);
}

void SetupReport::sayFault() {
  const std::string fault = explain(setup_->finding(), base_, camera_);
  if (fault == fault_) return;
  warnings_.say(fault.empty() ? "camera and odometry agree again: both are used" : fault);
  fault_ = fault;
}

void SetupReport::fill(Status& status) const {
  toStatus(time_offset_ ? time_offset_->estimate() : TimeOffset{}, used_s_, status);
  status.setup_fault = nameOf(setup_ ? finding().fault : SetupFault::kNone);
}

void SetupReport::diagnose(diagnostic_updater::DiagnosticStatusWrapper& wrapper) const {
  if (!setup_) return;
  const SetupFinding& found = finding();
  wrapper.add("set-up", !fault_.empty()      ? fault_
                        : found.is_confirmed ? "camera and odometry agree"
                                             : "not told yet: turn, and fly about");
  const TimeOffset& offset = time_offset_->estimate();
  if (offset.state == TimeOffsetState::kKnown) {
    wrapper.add("image time offset [s], estimated", offset.offset_s);
    wrapper.add("its deviation [s]", offset.sigma_s);
  } else {
    wrapper.add("image time offset [s], estimated", explain(offset.state));
  }
  const std::string advice = adviceOn(offset, used_s_);
  if (!advice.empty()) wrapper.add("image time offset", advice);
}

}  // namespace ardrone_vslam
