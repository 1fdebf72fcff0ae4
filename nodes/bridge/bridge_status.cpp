// SPDX-License-Identifier: BSD-3-Clause
#include "bridge/bridge_status.hpp"

#include <array>

#include "protocol/clocks.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::uint32_t kStatusQueue = 100;
constexpr double kSilent_s = 1;  // without a datagram: five answers a second come at least

constexpr std::array<const char*, kDatagramFaultCount> kCountNames{
    "datagrams of another program", "datagrams of another version", "datagrams of another kind",
    "datagrams of a wrong size",    "datagrams corrupted",          "datagrams with bad numbers",
    "datagrams late or twice"};

}  // namespace

BridgeStatus::BridgeStatus(ros::NodeHandle nh, const ros::NodeHandle& private_nh,
                           const Names& names, const Parts& parts, Warnings& warnings)
    : names_(names),
      parts_(parts),
      warnings_(warnings),
      publisher_(nh.advertise<Status>("status", kStatusQueue)),
      diagnostics_(nh, private_nh, names.node) {
  diagnostics_.setHardwareID("none");
  diagnostics_.add("onboard_bridge", this, &BridgeStatus::diagnose);
}

void BridgeStatus::hear() {
  heard_ns_ = now_ns();
}

void BridgeStatus::publishAnswer(Status& status, bool has_pose) {
  if (has_pose) {
    ++poses_;
    seconds_without_pose_ = 0;
  }
  publish(status);
}

void BridgeStatus::publish(Status& status) {
  status.header.frame_id = names_.map_frame;
  if (status.reason.empty()) status.reason = parts_.clock.fault();
  const DroneStream::Counts& counts = parts_.stream.counts();
  status.images = poses_;
  status.dropped_bad_message = counts.bad();
  status.dropped_stamp = counts.of(DatagramFault::kLate);
  status.dropped_queue = parts_.stream.posesLost();
  status.restarts = counts.restarts;
  publisher_.publish(status);
  latest_ = status;
}

/// One that has said that it ends is not silent.
bool BridgeStatus::isSilent() const {
  const double silent_s = static_cast<double>(now_ns() - heard_ns_) * 1e-9;
  return heard_ns_ == 0 || (silent_s > kSilent_s && latest_.state != Status::ENDED);
}

void BridgeStatus::endSecond() {
  remind();
  diagnostics_.force_update();
}

void BridgeStatus::remind() {
  const std::lock_guard<std::mutex> lock(parts_.mutex);
  Status status = latest_;
  const bool is_silent = isSilent();
  if (is_silent) {
    status.state = Status::DRONE_SILENT;
    status.state_name = "drone_silent";
    status.reason = "nothing comes from vslam_onboard at " + names_.receiving_at +
                    ": does it run, does its `telemetry_address` name this computer and this "
                    "port, has the computer joined the drone's network, and "
                    "does its firewall let UDP in?";
  }
  if (is_silent || status.state == Status::ENDED) {
    status.header.stamp = ros::Time::now();
    publish(status);
  }
  if (isReminderDue(++seconds_without_pose_))
    warnings_.say("no pose: " + latest_.state_name + ": " + latest_.reason);
}

unsigned char BridgeStatus::level() const {
  using diagnostic_msgs::DiagnosticStatus;
  switch (latest_.state) {
    case Status::DRONE_SILENT:
    case Status::ENDED:
    case Status::CAMERA_LOST:
    case Status::CONTROLLER_SILENT:
    case Status::WAITING_FOR_ODOMETRY:
    case Status::NOT_FINITE:
    case Status::OUT_OF_MEMORY:
      return DiagnosticStatus::ERROR;
    default:
      return isWell(latest_.state) && parts_.clock.fault().empty() ? DiagnosticStatus::OK
                                                                   : DiagnosticStatus::WARN;
  }
}

void BridgeStatus::diagnose(diagnostic_updater::DiagnosticStatusWrapper& wrapper) {
  const std::lock_guard<std::mutex> lock(parts_.mutex);
  wrapper.summary(level(), latest_.reason.empty() ? latest_.state_name
                                                  : latest_.state_name + ": " + latest_.reason);
  wrapper.add("receiving at", names_.receiving_at);
  const DroneStream& stream = parts_.stream;
  const DroneStream::Counts& counts = stream.counts();
  wrapper.add("answers", counts.poses);
  wrapper.add("answers with a pose", poses_);
  wrapper.add("answers lost", stream.posesLost());
  wrapper.add("telemetry", counts.telemetry);
  wrapper.add("telemetry lost", stream.telemetryLost());
  wrapper.add("telemetry without the answer of its image", telemetry_late_);
  for (std::size_t i = 0; i < kDatagramFaultCount; ++i)
    wrapper.add(kCountNames[i], counts.faults[i]);
  wrapper.add("restarts", counts.restarts);
  wrapper.add("landmarks received", stream.telemetry().size());
  wrapper.add("landmarks on the drone", latest_.landmarks);
  wrapper.add("features outside of the calibration's image",
              parts_.features ? parts_.features->outside() : 0);
  parts_.clock.diagnose(wrapper);
  wrapper.add("on the drone: images dropped", latest_.images_dropped);
  wrapper.add("on the drone: records dropped", latest_.odometry_refused);
}

}  // namespace ardrone_vslam
