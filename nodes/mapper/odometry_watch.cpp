// SPDX-License-Identifier: BSD-3-Clause
#include "mapper/odometry_watch.hpp"

#include "inputs/tf_buffer.hpp"

namespace ardrone_vslam {

void OdometryWatch::seeMessage(const OdometryState& message) {
  if (!covariance_fault_.empty()) return;
  covariance_fault_ = covarianceFault(message);
  if (!covariance_fault_.empty()) warnings_.say(topic_ + ": " + covariance_fault_);
}

void OdometryWatch::seeState(const OdometryState& state) {
  if (speed_.absurd_m_s() > 0) return;
  speed_.see(state);
  if (speed_.absurd_m_s() > 0) warnings_.say(speedFault());
}

void OdometryWatch::seeFaults(const OdometryFaultCounts& faults) {
  for (std::size_t i = 0; i < kOdometryFaultCount; ++i) {
    const auto fault = static_cast<OdometryFault>(i);
    if (faults[i] == faults_[i] || !isWorthWarning(fault)) continue;
    warnings_.limited(subject() + " " + explain(fault));
  }
  faults_ = faults;
}

void OdometryWatch::seeStep(double step_m) {
  if (step_m == 0) return;
  ++steps_;
  warnings_.limited(explainStep(subject(), step_m));
}

void OdometryWatch::seeFrames(const tf2::BufferCore& tf, const Frames& frames) {
  if (!frame_fault_.empty() || frames.odom.empty() || frames.base.empty()) return;
  frame_fault_ = odomFrameFault(tf, frames.map, frames.odom, frames.base);
  if (!frame_fault_.empty()) warnings_.say(frame_fault_);
}

void OdometryWatch::beginMapAnew() {
  standstill_.reset();
  speed_ = {};
}

std::string OdometryWatch::speedFault() const {
  return speed_.absurd_m_s() > 0 ? explainSpeed(subject(), speed_.absurd_m_s()) : "";
}

void OdometryWatch::diagnose(diagnostic_updater::DiagnosticStatusWrapper& wrapper) const {
  if (!covariance_fault_.empty()) wrapper.add("odometry covariance", covariance_fault_);
  if (speed_.absurd_m_s() > 0) wrapper.add("odometry speed", speedFault());
  if (!frame_fault_.empty()) wrapper.add("odometry frame", frame_fault_);
}

}  // namespace ardrone_vslam
