// SPDX-License-Identifier: BSD-3-Clause
#include "protocol/telemetry_reader.hpp"

#include <cassert>
#include <cmath>
#include <cstring>
#include <iterator>

#include "protocol/clocks.hpp"
#include "protocol/telemetry.hpp"
#include "protocol/vslam_protocol.h"

namespace ardrone_vslam {
namespace {

const std::uint8_t* getFloat(const std::uint8_t* from, float& value) {
  std::uint32_t bits = 0;
  from = vslam_get_u32(from, &bits);
  std::memcpy(&value, &bits, sizeof value);
  return from;
}

const std::uint8_t* getPixel(const std::uint8_t* from, float& pixel_px) {
  std::uint64_t sixteenths = 0;
  from = vslam_get(from, &sixteenths, 2);
  pixel_px = static_cast<float>(sixteenths) / 16;
  return from;
}

const std::uint8_t* getCount(const std::uint8_t* from, std::size_t& count) {
  std::uint64_t wide = 0;
  from = vslam_get(from, &wide, 2);
  count = static_cast<std::size_t>(wide);
  return from;
}

const std::uint8_t* getLandmark(const std::uint8_t* from, Landmark& landmark) {
  from = vslam_get_u32(from, &landmark.id);
  Eigen::Vector3f position_map;
  for (int axis = 0; axis < 3; ++axis) from = getFloat(from, position_map[axis]);
  landmark.position_map = position_map.cast<double>();
  return getFloat(from, landmark.sigma_m);
}

bool isFinite(const Landmark& landmark) {
  return landmark.position_map.allFinite() && std::isfinite(landmark.sigma_m);
}

}  // namespace

bool TelemetryReader::read(const std::uint8_t* datagram, std::size_t size) {
  assert(vslam_check(datagram, size, VSLAM_KIND_TELEMETRY, size) == VSLAM_GOOD);
  if (size < Telemetry::kFixedBytes + VSLAM_CRC_BYTES) return false;
  std::int64_t stamp_ns = 0;
  std::uint32_t on_drone = 0;
  std::uint32_t round = 0;
  std::size_t feature_count = 0;
  std::size_t landmark_count = 0;
  const std::uint8_t* from = vslam_get_i64(datagram + VSLAM_HEADER_BYTES, &stamp_ns);
  from = vslam_get_u32(from, &on_drone);
  from = vslam_get_u32(from, &round);
  from = getCount(from, feature_count);
  from = getCount(from, landmark_count);
  const std::size_t expected = Telemetry::kFixedBytes + feature_count * Telemetry::kFeatureBytes +
                               landmark_count * Telemetry::kLandmarkBytes + VSLAM_CRC_BYTES;
  if (size != expected || stamp_ns <= 0 || stamp_ns > kLatestStamp_ns) return false;

  const std::uint8_t* of_landmarks = from + feature_count * Telemetry::kFeatureBytes;
  arrived_.clear();
  for (std::size_t i = 0; i < landmark_count; ++i) {
    of_landmarks = getLandmark(of_landmarks, arrived_.emplace_back());
    if (!isFinite(arrived_.back())) return false;
  }
  features_.clear();
  features_.stamp_ns = stamp_ns;
  for (std::size_t i = 0; i < feature_count; ++i) {
    std::uint64_t age = 0;
    Eigen::Vector2f& pixel_px = features_.pixel_px.emplace_back();
    from = getPixel(from, pixel_px.x());
    from = getPixel(from, pixel_px.y());
    from = vslam_get(from, &age, 1);
    features_.age_frames.push_back(static_cast<std::uint16_t>(age));
  }
  on_drone_ = on_drone;
  const bool is_full = landmarks_.size() + landmark_count > kMostLandmarks;
  if (on_drone == 0 || round < round_ || is_full) landmarks_.clear();
  for (const Landmark& landmark : arrived_) landmarks_[landmark.id] = {landmark, round};
  if (round > round_) forgetOld(round);
  round_ = round;
  return true;
}

/// A landmark counts for the round of the datagram's end: it may have come at the end of the one
/// before.
void TelemetryReader::forgetOld(std::uint32_t round) {
  for (auto it = landmarks_.begin(); it != landmarks_.end();) {
    it = round - it->second.round > kForgetRounds ? landmarks_.erase(it) : std::next(it);
  }
}

Landmarks TelemetryReader::landmarks() const {
  Landmarks all;
  all.reserve(landmarks_.size());
  for (const auto& [id, received] : landmarks_) all.push_back(received.landmark);
  return all;
}

}  // namespace ardrone_vslam
