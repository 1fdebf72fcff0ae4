// SPDX-License-Identifier: BSD-3-Clause
#include "tracker/tracker_status.hpp"

namespace ardrone_vslam {

TrackerStatus::TrackerStatus(const ros::NodeHandle& nh, const ros::NodeHandle& private_nh,
                             const std::string& name, const Parts& parts, Warnings& warnings)
    : parts_(parts),
      warnings_(warnings),
      watch_(parts.images, warnings),
      diagnostics_(nh, private_nh, name) {
  diagnostics_.setHardwareID("none");
  diagnostics_.add("tracker", this, &TrackerStatus::diagnose);
}

std::uint64_t TrackerStatus::countProcessed() {
  fault_.clear();
  return ++processed_;
}

void TrackerStatus::drop(const std::string& fault) {
  ++dropped_;
  fault_ = fault;
  warnings_.limited(fault, "image dropped (" + std::to_string(dropped_) + " so far): " + fault);
}

void TrackerStatus::endSecond() {
  rate_hz_ = static_cast<double>(processed_ - processed_before_);
  processed_before_ = processed_;
  watch_.endSecond();
  diagnostics_.force_update();
}

void TrackerStatus::diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using diagnostic_msgs::DiagnosticStatus;
  if (!watch_.waitingFor().empty()) {
    status.summary(DiagnosticStatus::WARN, watch_.waitingFor());
  } else if (!fault_.empty()) {
    status.summary(DiagnosticStatus::ERROR, "images are dropped: " + fault_);
  } else if (!watch_.loss().empty()) {
    status.summary(DiagnosticStatus::WARN, watch_.loss());
  } else {
    status.summary(DiagnosticStatus::OK, "tracking");
  }
  const ImageQueue::Counts counts = parts_.images.counts();
  status.add("images per second", rate_hz_);
  status.add("images received", counts.images);
  status.add("images processed", processed_);
  status.add("images dropped", dropped_);
  status.add("images dropped while the tracker was busy", counts.overflowed);
  status.add("images without camera_info", counts.without_info);
  status.add("images waiting", counts.waiting);
  if (parts_.attitude) status.add("images without attitude", parts_.attitude->imagesWithout());
  if (!parts_.changes.changed().empty())
    status.add("parameters changed in flight", parts_.changes.changed());
  status.add("features in the latest image", parts_.tracker.features().size());
  status.add("tracks in the latest image", parts_.tracker.features().tracked());
  status.add("tracks aligned in the latest image", parts_.tracker.features().aligned());
}

}  // namespace ardrone_vslam
