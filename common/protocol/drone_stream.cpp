// SPDX-License-Identifier: BSD-3-Clause
#include "protocol/drone_stream.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <numeric>

#include "protocol/clocks.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kNormTolerance = 1e-3;
constexpr std::size_t kVersionAt = 4;
constexpr std::size_t kKindAt = 5;

bool isKnown(std::uint32_t state) {
  return state <= VSLAM_LAST_STATE ||
         (state >= VSLAM_WAITING_FOR_IMAGES && state <= VSLAM_OUT_OF_MEMORY);
}

template <std::size_t N>
bool allFinite(const double (&values)[N]) {
  return std::all_of(std::begin(values), std::end(values),
                     [](double v) { return std::isfinite(v); });
}

bool isRotation(const double (&q)[4]) {
  const double norm = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  return std::abs(norm - 1) < kNormTolerance;  // false for what is not finite
}

bool canBe(const VslamPose& pose) {
  if (!isKnown(pose.state) || pose.stamp_ns < 0 || pose.stamp_ns > kLatestStamp_ns) return false;
  if ((pose.flags & VSLAM_POSE_IS_VALID) == 0) return true;
  return pose.state <= VSLAM_LAST_STATE && pose.state != VSLAM_NOT_FINITE && pose.stamp_ns > 0 &&
         allFinite(pose.position_m) && isRotation(pose.quaternion) && allFinite(pose.deviation) &&
         std::all_of(std::begin(pose.deviation), std::end(pose.deviation),
                     [](double deviation) { return deviation >= 0; }) &&
         allFinite(pose.observer_position_m) && isRotation(pose.observer_quaternion);
}

DatagramFault toDatagramFault(VslamFault fault) {
  switch (fault) {
    case VSLAM_WRONG_KIND:
      return DatagramFault::kKind;
    case VSLAM_WRONG_SIZE:
      return DatagramFault::kSize;
    case VSLAM_GOOD:
    case VSLAM_CORRUPTED:
      break;
  }
  return DatagramFault::kCorrupted;
}

}  // namespace

const char* explain(DatagramFault fault) {
  switch (fault) {
    case DatagramFault::kForeign:
      return "it is not vslam_onboard's: something else sends to this port; set another one here "
             "and in its telemetry_address";
    case DatagramFault::kVersion:
      return "it is of another version of the protocol: build vslam_onboard and onboard_bridge "
             "from the same release";
    case DatagramFault::kKind:
      return "it is neither an answer nor telemetry: a flight controller sends to this port; its "
             "records go to vslam_onboard's `observer` (ADDRESS:PORT)";
    case DatagramFault::kSize:
      return "it is shorter or longer than it says";
    case DatagramFault::kCorrupted:
      return "its CRC is wrong: it was damaged on its way";
    case DatagramFault::kRefused:
      return "its numbers cannot be: build vslam_onboard and onboard_bridge from the same release";
    case DatagramFault::kLate:
      return "a newer one overtook it, or it came twice: a bad wireless link, or two programs send "
             "to this port";
  }
  return "";
}

std::uint64_t DroneStream::Counts::bad() const {
  return std::accumulate(faults.begin(), faults.end(), std::uint64_t{0}) - of(DatagramFault::kLate);
}

DroneStream::Read DroneStream::drop(DatagramFault fault) {
  fault_ = fault;
  ++counts_.faults[static_cast<std::size_t>(fault)];
  return Read::kNothing;
}

DroneStream::Read DroneStream::read(const std::uint8_t* datagram, std::size_t size,
                                    std::int64_t now_ns) {
  std::uint64_t magic = 0;
  if (size >= VSLAM_HEADER_BYTES) vslam_get(datagram, &magic, 4);
  if (magic != VSLAM_MAGIC) return drop(DatagramFault::kForeign);
  if (datagram[kVersionAt] != VSLAM_VERSION) return drop(DatagramFault::kVersion);
  if (datagram[kKindAt] == VSLAM_KIND_TELEMETRY) return readTelemetry(datagram, size, now_ns);
  return readPose(datagram, size, now_ns);
}

DroneStream::Read DroneStream::readPose(const std::uint8_t* datagram, std::size_t size,
                                        std::int64_t now_ns) {
  VslamPose pose;
  const VslamFault fault = vslam_read_pose(datagram, size, &pose);
  if (fault != VSLAM_GOOD) return drop(toDatagramFault(fault));
  if (!canBe(pose)) return drop(DatagramFault::kRefused);
  const bool has_stamp = pose.stamp_ns > 0;
  bool is_restart = has_stamp && pose.stamp_ns <= stamp_ns_ - kRestart_ns;
  switch (pose_guard_.check(pose.sequence, now_ns)) {
    case SequenceGuard::Answer::kLate:
      return drop(DatagramFault::kLate);
    case SequenceGuard::Answer::kRestart:
      is_restart = true;
      break;
    case SequenceGuard::Answer::kNew:
      break;
  }
  if (is_restart) restart();
  // Whoever pairs poses by their stamps is to find them ascending.
  const bool is_valid = (pose.flags & VSLAM_POSE_IS_VALID) != 0;
  if (is_valid && pose.stamp_ns <= stamp_ns_) return drop(DatagramFault::kRefused);
  if (has_stamp) stamp_ns_ = pose.stamp_ns;
  if (beganMapAnew(pose)) telemetry_.forgetLandmarks();
  pose_ = pose;
  ++counts_.poses;
  return Read::kPose;
}

DroneStream::Read DroneStream::readTelemetry(const std::uint8_t* datagram, std::size_t size,
                                             std::int64_t now_ns) {
  const VslamFault fault = vslam_check(datagram, size, VSLAM_KIND_TELEMETRY, size);
  if (fault != VSLAM_GOOD) return drop(toDatagramFault(fault));
  std::uint32_t sequence = 0;
  vslam_get_u32(datagram + 8, &sequence);
  switch (telemetry_guard_.check(sequence, now_ns)) {
    case SequenceGuard::Answer::kLate:
      return drop(DatagramFault::kLate);
    case SequenceGuard::Answer::kRestart:
      telemetry_ = {};
      break;
    case SequenceGuard::Answer::kNew:
      break;
  }
  if (!telemetry_.read(datagram, size)) return drop(DatagramFault::kRefused);
  ++counts_.telemetry;
  return Read::kTelemetry;
}

/// The answers tell it first: each image has one, and its telemetry comes behind it.
void DroneStream::restart() {
  ++counts_.restarts;
  stamp_ns_ = 0;
  telemetry_ = {};
  telemetry_guard_.restart();
}

}  // namespace ardrone_vslam
