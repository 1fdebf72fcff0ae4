// SPDX-License-Identifier: BSD-3-Clause
#include "protocol/telemetry.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "protocol/vslam_protocol.h"

namespace ardrone_vslam {
namespace {

static_assert(Telemetry::kFixedBytes == VSLAM_HEADER_BYTES + 8 + 4 + 4 + 2 + 2);

std::uint8_t* putFloat(std::uint8_t* to, double value) {
  const auto narrow = static_cast<float>(value);
  std::uint32_t bits = 0;
  std::memcpy(&bits, &narrow, sizeof bits);
  return vslam_put(to, bits, 4);
}

std::uint8_t* putPixel(std::uint8_t* to, float pixel_px) {
  return vslam_put(to, static_cast<std::uint64_t>(std::lround(std::max(pixel_px, 0.F) * 16)), 2);
}

std::uint8_t* putLandmark(std::uint8_t* to, const Landmark& landmark) {
  to = vslam_put(to, landmark.id, 4);
  for (int axis = 0; axis < 3; ++axis) to = putFloat(to, landmark.position_map[axis]);
  return putFloat(to, landmark.sigma_m);
}

}  // namespace

std::size_t Telemetry::write(const ImageFeatures& features, const Landmarks& map,
                             std::array<std::uint8_t, kBytes>& datagram) {
  const std::size_t feature_count = std::min(features.size(), kMostFeatures);
  const std::size_t room =
      (kBytes - kFixedBytes - VSLAM_CRC_BYTES - feature_count * kFeatureBytes) / kLandmarkBytes;
  std::uint8_t* to = datagram.data() + kFixedBytes;
  for (std::size_t i = 0; i < feature_count; ++i) {
    const std::size_t of = i * features.size() / feature_count;  // spread over all
    to = putPixel(to, features.pixel_px[of].x());
    to = putPixel(to, features.pixel_px[of].y());
    to = vslam_put(to, std::min<std::uint16_t>(features.age_frames[of], 255), 1);
  }
  const Landmarks& landmarks = map;
  std::size_t sent = 0;
  // Those just seen get at most half of the room, so that the round goes on.
  if (seen_cursor_ >= landmarks.size()) seen_cursor_ = 0;
  for (std::size_t i = 0; i < landmarks.size() && sent < room / 2; ++i) {
    const Landmark& landmark = landmarks[seen_cursor_];
    if (++seen_cursor_ >= landmarks.size()) seen_cursor_ = 0;
    if (landmark.last_seen_ns <= last_ns_) continue;
    to = putLandmark(to, landmark);
    ++sent;
  }
  for (std::size_t i = 0; i < landmarks.size() && sent < room; ++i, ++sent) {
    if (cursor_ >= landmarks.size()) {
      cursor_ = 0;
      ++round_;
    }
    to = putLandmark(to, landmarks[cursor_++]);
  }
  last_ns_ = features.stamp_ns;

  const std::size_t size = static_cast<std::size_t>(to - datagram.data()) + VSLAM_CRC_BYTES;
  to = vslam_put_header(datagram.data(), VSLAM_KIND_TELEMETRY, size, ++sequence_);
  to = vslam_put(to, static_cast<std::uint64_t>(features.stamp_ns), 8);
  to = vslam_put(to, landmarks.size(), 4);
  to = vslam_put(to, round_, 4);
  to = vslam_put(to, feature_count, 2);
  vslam_put(to, sent, 2);
  vslam_put_crc(datagram.data(), size);
  return size;
}

}  // namespace ardrone_vslam
