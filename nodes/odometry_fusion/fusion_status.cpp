// SPDX-License-Identifier: BSD-3-Clause
#include "odometry_fusion/fusion_status.hpp"

#include <utility>

namespace ardrone_vslam {

FusionStatus::FusionStatus(const ros::NodeHandle& nh, const ros::NodeHandle& private_nh,
                           const std::string& name, Topics topics, const DelayedFusion& fusion,
                           const CorrectionQueue& corrections, Warnings& warnings)
    : topics_(std::move(topics)),
      fusion_(fusion),
      corrections_(corrections),
      warnings_(warnings),
      diagnostics_(nh, private_nh, name) {
  diagnostics_.setHardwareID("none");
  diagnostics_.add("odometry_fusion", this, &FusionStatus::diagnose);
}

void FusionStatus::refuseOdometry(const std::string& fault) {
  ++odometry_refused_;
  warnings_.refuse(topics_.odometry, fault);
}

void FusionStatus::refuseCorrection(const std::string& fault) {
  ++corrections_refused_;
  warnings_.refuse(topics_.correction, fault);
}

std::string FusionStatus::waitingFor() const {
  if (!has_odometry_) {
    return "no odometry on " + topics_.odometry + ": nothing is published";
  }
  if (!has_correction_ && !fusion_.hasCorrection()) {
    return "no correction on " + topics_.correction +
           " yet: nothing is published; is the mapper running? Its status says why it waits";
  }
  if (!fusion_.hasCorrection()) return "no correction could be used; the warnings say why";
  if (!has_correction_) {
    return "no correction on " + topics_.correction +
           " for a second: the odometry drifts on from the last one";
  }
  return {};
}

void FusionStatus::endSecond() {
  const std::string waiting = waitingFor();
  if (waiting != waited_for_) reminder_ = Reminder();
  waited_for_ = waiting;
  if (reminder_.isDue(!waiting.empty())) warnings_.say(waiting);
  diagnostics_.force_update();
  has_odometry_ = false;
  has_correction_ = false;
}

void FusionStatus::diagnose(diagnostic_updater::DiagnosticStatusWrapper& wrapper) {
  using diagnostic_msgs::DiagnosticStatus;
  const std::string waiting = waitingFor();
  const auto level = waiting.empty()                            ? DiagnosticStatus::OK
                     : has_odometry_ && fusion_.hasCorrection() ? DiagnosticStatus::WARN
                                                                : DiagnosticStatus::ERROR;
  wrapper.summary(static_cast<unsigned char>(level), waiting.empty() ? "publishing" : waiting);
  wrapper.add("corrections used", corrections_.used());
  wrapper.add("corrections refused", corrections_refused_);
  wrapper.add("of them older than the buffer", corrections_.tooOld());
  wrapper.add("odometry messages refused", odometry_refused_);
  wrapper.add("restarts", restarts_);
  if (!fusion_.hasCorrection()) return;
  wrapper.add("age of the correction [s]",
              static_cast<double>(fusion_.newestStamp_ns() - fusion_.correctionStamp_ns()) * 1e-9);
}

}  // namespace ardrone_vslam
