// SPDX-License-Identifier: BSD-3-Clause
// Datagrams of both directions: dropped by cause, or answers and records that can be.
#include <array>
#include <cmath>

#include "fuzz/fuzz_input.hpp"
#include "input/observer_input.hpp"
#include "protocol/clock_map.hpp"
#include "protocol/clocks.hpp"
#include "protocol/drone_stream.hpp"
#include "protocol/telemetry.hpp"

namespace ardrone_vslam::fuzz {
namespace {

constexpr std::int64_t kArrival_ns = 20'000'000;  ///< between datagrams

bool isRotation(const double (&q)[4]) {
  return std::abs(std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3])) - 1) < 2e-3;
}

/// The workstation's side.
class Workstation {
 public:
  void read(const Bytes& datagram, std::int64_t now_ns) {
    switch (stream_.read(datagram.data(), datagram.size(), now_ns)) {
      case DroneStream::Read::kPose:
        requirePose(now_ns);
        break;
      case DroneStream::Read::kTelemetry:
        requireTelemetry();
        break;
      case DroneStream::Read::kNothing:
        require(explain(stream_.fault())[0] != '\0', "what is dropped has a reason");
        break;
    }
  }

 private:
  void requirePose(std::int64_t now_ns) {
    const VslamPose& pose = stream_.pose();
    require(pose.stamp_ns >= 0 && pose.stamp_ns <= kLatestStamp_ns, "stamps are within bounds");
    if ((pose.flags & VSLAM_POSE_IS_VALID) == 0) return;
    for (const double x : pose.position_m) require(std::isfinite(x), "positions are finite");
    for (const double s : pose.deviation) require(std::isfinite(s) && s >= 0, "deviations are");
    require(isRotation(pose.quaternion) && isRotation(pose.observer_quaternion),
            "attitudes are rotations");
    require(pose.state <= VSLAM_LAST_STATE, "a pose's state is one of Slam's");
    clocks_.map(pose.stamp_ns, now_ns);
  }

  void requireTelemetry() const {
    const ImageFeatures& features = stream_.telemetry().features();
    require(features.stamp_ns > 0 && features.stamp_ns <= kLatestStamp_ns, "stamps are in bounds");
    require(features.age_frames.size() == features.pixel_px.size(), "each feature has its age");
    for (const Landmark& landmark : stream_.telemetry().landmarks())
      require(landmark.position_map.allFinite() && std::isfinite(landmark.sigma_m),
              "landmarks are finite");
  }

  DroneStream stream_;
  ClockMap clocks_;
};

/// The drone's side.
void readRecord(ObserverInput& input, const Bytes& record, std::int64_t now_ns) {
  const auto state = input.read(record.data(), record.size(), now_ns);
  if (!state) return;
  require(state->T_odom_base.matrix().allFinite() && state->covariance.allFinite(),
          "the observer's states are finite");
  require(state->T_odom_base.linear().isUnitary(1e-6), "and their attitudes rotations");
  VslamObserver observer{};
  require(vslam_read_observer(record.data(), record.size(), &observer) == VSLAM_GOOD, "is good");
  std::array<std::uint8_t, VSLAM_OBSERVER_BYTES> again{};
  vslam_write_observer(&observer, again.data());
  require(std::equal(record.begin(), record.end(), again.begin(), again.end()),
          "a record is written as it was read");
}

Bytes observerRecord(std::uint32_t sequence) {
  VslamObserver o{};
  o.sequence = sequence;
  o.flags = VSLAM_OBSERVER_HAS_VARIANCE | VSLAM_OBSERVER_HAS_HEIGHT;
  o.stamp_ns = 1'000'000'000 + 5'000'000 * std::int64_t{sequence};
  o.quaternion[3] = 1;
  o.variance[0] = 0.01;
  o.height_m = 1.5;
  Bytes bytes(VSLAM_OBSERVER_BYTES);
  vslam_write_observer(&o, bytes.data());
  return bytes;
}

Bytes poseRecord(std::uint32_t sequence, std::uint32_t state) {
  VslamPose p{};
  p.sequence = sequence;
  p.flags = state <= VSLAM_LAST_STATE ? VSLAM_POSE_IS_VALID : 0;
  p.state = state;
  p.stamp_ns = 1'000'000'000 + 30'000'000 * std::int64_t{sequence};
  p.quaternion[3] = p.observer_quaternion[3] = 1;
  p.landmarks = 7;
  Bytes bytes(VSLAM_POSE_BYTES);
  vslam_write_pose(&p, bytes.data());
  return bytes;
}

Bytes telemetryDatagram(Telemetry& telemetry, std::int64_t stamp_ns, std::uint32_t landmarks) {
  ImageFeatures features;
  features.stamp_ns = stamp_ns;
  for (int i = 0; i < 3; ++i) {
    features.pixel_px.emplace_back(20.F * static_cast<float>(i), 100.F);
    features.age_frames.push_back(static_cast<std::uint16_t>(i));
  }
  std::vector<Landmark> map(landmarks);
  for (std::uint32_t i = 0; i < landmarks; ++i) map[i].id = i + 1;
  std::array<std::uint8_t, Telemetry::kBytes> datagram{};
  const std::size_t size = telemetry.write(features, map, datagram);
  return {datagram.begin(), datagram.begin() + static_cast<std::ptrdiff_t>(size)};
}

Bytes joined(const std::vector<Bytes>& datagrams) {
  Bytes all;
  for (const Bytes& datagram : datagrams) putPart(all, datagram);
  return all;
}

}  // namespace

std::vector<Bytes> seeds() {
  Telemetry telemetry;
  const Bytes first = telemetryDatagram(telemetry, 1'000'000'000, 4);
  const Bytes second = telemetryDatagram(telemetry, 1'100'000'000, 4);
  return {joined({observerRecord(1), observerRecord(2), observerRecord(2)}),
          joined({poseRecord(1, VSLAM_WAITING_FOR_IMAGES), poseRecord(2, VSLAM_TRACKING),
                  poseRecord(3, VSLAM_TRACKING)}),
          joined({poseRecord(200, VSLAM_TRACKING), poseRecord(1, VSLAM_TRACKING)}),
          joined({first, second, poseRecord(3, VSLAM_NOT_FINITE)}), joined({second, first})};
}

/// Each datagram's magic, version, size and check sum.
std::size_t repair(std::uint8_t* data, std::size_t size, std::size_t /*most_size*/) {
  for (std::size_t at = 0; size - at > 2;) {
    const std::size_t said = data[at] | static_cast<std::size_t>(data[at + 1]) << 8U;
    const std::size_t count = std::min(said, size - at - 2);
    std::uint8_t* const datagram = data + at + 2;
    vslam_put(data + at, count, 2);
    if (count >= VSLAM_HEADER_BYTES + VSLAM_CRC_BYTES) {
      vslam_put(datagram, VSLAM_MAGIC, 4);
      vslam_put(datagram + 4, VSLAM_VERSION, 1);
      vslam_put(datagram + 6, count, 2);
      vslam_put_crc(datagram, count);
    }
    at += 2 + count;
  }
  return size;
}

}  // namespace ardrone_vslam::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ardrone_vslam;
  fuzz::FuzzInput input(data, size);
  fuzz::Workstation workstation;
  ObserverInput drone;
  std::int64_t now_ns = 1'000'000'000;
  while (input.left() > 0) {
    const fuzz::Bytes datagram = input.part(input.take<std::uint16_t>()).rest();
    workstation.read(datagram, now_ns);
    fuzz::readRecord(drone, datagram, now_ns);
    now_ns += fuzz::kArrival_ns;
  }
  return 0;
}
