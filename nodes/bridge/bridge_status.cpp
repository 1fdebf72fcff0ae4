// SPDX-License-Identifier: BSD-3-Clause
// What onboard_bridge says of the drone and of itself: status, warnings, diagnostics.
#include <sstream>

#include "bridge/onboard_bridge_nodelet.hpp"
#include "protocol/clocks.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kSilent_s = 1;       // without a datagram: five answers a second come at least
constexpr double kClocksApart_s = 5;  // more than any delay of a link that is of use

constexpr std::array<const char*, kDatagramFaultCount> kCountNames{
    "datagrams of another program", "datagrams of another version", "datagrams of another kind",
    "datagrams of a wrong size",    "datagrams corrupted",          "datagrams with bad numbers",
    "datagrams late or twice"};

}  // namespace

void OnboardBridgeNodelet::noteClock(std::int64_t drone_ns) {
  const double late_s = ros::Time::now().toSec() - static_cast<double>(drone_ns) * 1e-9;
  clock_fault_.clear();
  if (std::abs(late_s) < kClocksApart_s) return;
  std::ostringstream text;
  text
      << "the drone's stamps are " << std::abs(late_s) << " s " << (late_s > 0 ? "before" : "after")
      << " this computer's time: synchronise both clocks and set vslam_onboard's `realtime_clock`, "
         "or set `same_clock` to false";
  clock_fault_ = text.str();
  // Limited by its kind: the seconds differ each time.
  if (limiter_.allows("same_clock", static_cast<double>(now_ns()) * 1e-9))
    NODELET_WARN_STREAM(clock_fault_);
}

void OnboardBridgeNodelet::publishStatus(Status& status) {
  status.header.frame_id = frames_.map;
  if (!clock_fault_.empty() && status.reason.empty()) status.reason = clock_fault_;
  const DroneStream::Counts& counts = stream_.counts();
  status.images = poses_;
  status.dropped_bad_message = counts.bad();
  status.dropped_stamp = counts.of(DatagramFault::kLate);
  status.dropped_queue = stream_.posesLost();
  status.restarts = counts.restarts;
  status_pub_.publish(status);
  latest_ = status;
}

/// One that has said that it ends is not silent.
bool OnboardBridgeNodelet::isSilent() const {
  const double silent_s = static_cast<double>(now_ns() - heard_ns_) * 1e-9;
  return heard_ns_ == 0 || (silent_s > kSilent_s && latest_.state != Status::ENDED);
}

void OnboardBridgeNodelet::onSecond() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    Status status = latest_;
    const bool is_silent = isSilent();
    if (is_silent) {
      status.state = Status::DRONE_SILENT;
      status.state_name = "drone_silent";
      status.reason = "nothing comes from vslam_onboard at " + receiving_at_ +
                      ": does it run, does its `telemetry_address` name this computer and this "
                      "port, has the computer joined the drone's network, and "
                      "does its firewall let UDP in?";
    }
    if (is_silent || status.state == Status::ENDED) {
      status.header.stamp = ros::Time::now();
      publishStatus(status);
    }
    if (isReminderDue(++seconds_without_pose_))
      NODELET_WARN_STREAM("no pose: " << latest_.state_name << ": " << latest_.reason);
  }
  diagnostics_->force_update();
}

void OnboardBridgeNodelet::diagnose(diagnostic_updater::DiagnosticStatusWrapper& wrapper) {
  using diagnostic_msgs::DiagnosticStatus;
  const std::lock_guard<std::mutex> lock(mutex_);
  const bool is_stuck =
      latest_.state == Status::DRONE_SILENT || latest_.state == Status::ENDED ||
      latest_.state == Status::CAMERA_LOST || latest_.state == Status::CONTROLLER_SILENT ||
      latest_.state == Status::WAITING_FOR_ODOMETRY || latest_.state == Status::NOT_FINITE ||
      latest_.state == Status::OUT_OF_MEMORY;
  const auto level = is_stuck                                        ? DiagnosticStatus::ERROR
                     : isWell(latest_.state) && clock_fault_.empty() ? DiagnosticStatus::OK
                                                                     : DiagnosticStatus::WARN;
  wrapper.summary(
      static_cast<unsigned char>(level),
      latest_.reason.empty() ? latest_.state_name : latest_.state_name + ": " + latest_.reason);
  wrapper.add("receiving at", receiving_at_);
  const DroneStream::Counts& counts = stream_.counts();
  wrapper.add("answers", counts.poses);
  wrapper.add("answers with a pose", poses_);
  wrapper.add("answers lost", stream_.posesLost());
  wrapper.add("telemetry", counts.telemetry);
  wrapper.add("telemetry lost", stream_.telemetryLost());
  wrapper.add("telemetry without the answer of its image", telemetry_late_);
  for (std::size_t i = 0; i < kDatagramFaultCount; ++i)
    wrapper.add(kCountNames[i], counts.faults[i]);
  wrapper.add("restarts", counts.restarts);
  wrapper.add("landmarks received", stream_.telemetry().size());
  wrapper.add("landmarks on the drone", latest_.landmarks);
  wrapper.add("features outside of the calibration's image", features_outside_);
  if (!config_.same_clock)
    wrapper.add("this computer's clock less the drone's [s]",
                static_cast<double>(clock_.offset_ns()) * 1e-9);
  if (!clock_fault_.empty()) wrapper.add("clocks", clock_fault_);
  wrapper.add("on the drone: images dropped", latest_.images_dropped);
  wrapper.add("on the drone: records dropped", latest_.odometry_refused);
}

}  // namespace ardrone_vslam
