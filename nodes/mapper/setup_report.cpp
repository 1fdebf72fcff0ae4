// SPDX-License-Identifier: BSD-3-Clause
#include "mapper/setup_report.hpp"

namespace ardrone_vslam {

void SetupReport::useCamera(const Eigen::Isometry3d& T_base_cam, const std::string& base,
                            const std::string& camera) {
  monitor_.useCamera(T_base_cam);
  base_ = base;
  camera_ = camera;
  fault_.clear();
}

void SetupReport::see(const ImageFeatures& features, const OdometryBuffer& odometries, Slam& slam) {
  const bool is_found = monitor_.see(features, odometries, slam);
  sayFault();
  const bool may_advise = clock().told_s() && !is_offset_told_ && fault_.empty();
  if (!is_found && !may_advise) return;
  const std::string advice = offsetAdvice();
  is_offset_told_ = !advice.empty();
  if (is_offset_told_) warnings_.say(advice);
}

std::string SetupReport::offsetAdvice() const {
  return adviceOn(clock().estimate(), clock().told_s(), clock().used_s());
}

void SetupReport::sayFault() {
  const std::string fault = explain(monitor_.finding(), base_, camera_);
  if (fault == fault_) return;
  warnings_.event(fault.empty() ? "camera and odometry agree again: both are used" : fault);
  fault_ = fault;
}

void SetupReport::fill(Status& status) const {
  toStatus(clock().estimate(), clock().used_s(), status);
  status.setup_fault = nameOf(monitor_.finding().fault);
}

void SetupReport::diagnose(diagnostic_updater::DiagnosticStatusWrapper& wrapper) const {
  const SetupFinding found = monitor_.finding();
  wrapper.add("set-up", !fault_.empty()      ? fault_
                        : found.is_confirmed ? "camera and odometry agree"
                                             : "not told yet: turn, and fly about");
  const TimeOffset offset = clock().estimate();
  wrapper.add("image time offset [s], in use", clock().used_s());
  if (offset.state == TimeOffsetState::kKnown) {
    wrapper.add("image time offset [s], estimated", offset.offset_s);
    wrapper.add("its deviation [s]", offset.sigma_s);
  } else {
    wrapper.add("image time offset [s], estimated", explain(offset.state));
  }
  const std::string advice = offsetAdvice();
  if (!advice.empty()) wrapper.add("image time offset", advice);
}

}  // namespace ardrone_vslam
