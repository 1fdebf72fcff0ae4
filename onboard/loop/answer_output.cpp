// SPDX-License-Identifier: BSD-3-Clause
#include "loop/answer_output.hpp"

#include <fcntl.h>
#include <sys/socket.h>

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <stdexcept>

#include "protocol/udp.hpp"

namespace ardrone_vslam {
namespace {

constexpr int kPosePort = 5581;
constexpr int kTelemetryPort = 5582;

void put(const Eigen::Isometry3d& T, double* position_m, double* quaternion) {
  const Eigen::Quaterniond q(T.linear());
  for (int axis = 0; axis < 3; ++axis) position_m[axis] = T.translation()[axis];
  for (int i = 0; i < 4; ++i) quaternion[i] = q.coeffs()[i];  // x, y, z, w
}

void say(const std::string& sentence) {
  std::fprintf(stderr, "vslam_onboard: %s\n", sentence.c_str());
}

}  // namespace

AnswerOutput::AnswerOutput(const OnboardConfig& config)
    : telemetry_period_ns_(std::llround(1e9 / config.telemetry_hz)) {
  if (!config.pose_address.empty())
    pose_socket_ = sendTo(udpAddressOf(config.pose_address, kPosePort));
  if (!config.telemetry_address.empty())
    telemetry_socket_ = sendTo(udpAddressOf(config.telemetry_address, kTelemetryPort));
  if (config.poses.empty()) return;
  pose_file_ = FileDescriptor(::open(config.poses.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644));
  if (!pose_file_.isOpen())
    throw std::runtime_error(config.poses + ": cannot be written: " + std::strerror(errno));
}

void AnswerOutput::sendPose(const FrameResult& result, const Counters& counters) {
  static_assert(VSLAM_POSE_WITHOUT_KEYFRAME == VSLAM_POSE_WITHOUT_PLACE_SEARCH
                                                   << static_cast<int>(OptionalWork::kKeyframe),
                "the flags are LeftOut's bits");
  VslamPose pose{};
  pose.flags = VSLAM_POSE_IS_VALID + static_cast<std::uint32_t>(result.left_out.to_ulong()) *
                                         VSLAM_POSE_WITHOUT_PLACE_SEARCH;
  pose.state = static_cast<std::uint32_t>(result.state);
  pose.stamp_ns = result.stamp_ns;
  put(result.T_map_base, pose.position_m, pose.quaternion);
  put(result.T_odom_base, pose.observer_position_m, pose.observer_quaternion);
  for (int i = 0; i < 6; ++i) pose.deviation[i] = std::sqrt(std::max(result.covariance(i, i), 0.0));
  send(pose, counters);
}

void AnswerOutput::sendState(std::uint32_t state, std::int64_t stamp_ns, const Counters& counters) {
  VslamPose pose{};
  pose.state = state;
  pose.stamp_ns = stamp_ns;
  send(pose, counters);
}

void AnswerOutput::send(VslamPose& pose, const Counters& counters) {
  pose.sequence = ++sequence_;
  pose.frames_dropped = counters.frames_dropped;
  pose.records_dropped = counters.records_dropped;
  pose.landmarks = counters.landmarks;
  std::array<std::uint8_t, VSLAM_POSE_BYTES> record;
  vslam_write_pose(&pose, record.data());
  for (const FileDescriptor* socket : {&pose_socket_, &telemetry_socket_}) {
    if (socket->isOpen()) ::send(socket->get(), record.data(), record.size(), MSG_NOSIGNAL);
  }
  if (!pose_file_.isOpen()) return;
  const auto written = ::write(pose_file_.get(), record.data(), record.size());
  if (written == static_cast<ssize_t>(record.size())) return;
  std::fprintf(stderr, "vslam_onboard: the poses' file cannot be written (%s) and is closed\n",
               std::strerror(errno));
  pose_file_ = FileDescriptor();
}

void AnswerOutput::saySetup(const SetupMonitor& setup) {
  const ImageClock& clock = setup.clock();
  if (!clock.told_s() && clock.used_s() != said_offset_s_) {
    said_offset_s_ = clock.used_s();
    say(adviceOn(clock.estimate(), clock.told_s(), clock.used_s()));
  }
  const SetupFinding finding = setup.finding();
  if (finding.fault == said_fault_) return;
  said_fault_ = finding.fault;
  const std::string fault = explain(finding, "BASE", "CAMERA");
  say(fault.empty() ? "camera and odometry agree again" : fault);
}

void AnswerOutput::sendTelemetry(const ImageFeatures& features, const Landmarks& map,
                                 std::int64_t now_ns) {
  if (!telemetry_socket_.isOpen() || now_ns - telemetry_sent_ns_ < telemetry_period_ns_) return;
  telemetry_sent_ns_ = now_ns;
  const std::size_t size = telemetry_.write(features, map, datagram_);
  ::send(telemetry_socket_.get(), datagram_.data(), size, MSG_NOSIGNAL);
}

}  // namespace ardrone_vslam
