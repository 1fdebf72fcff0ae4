// SPDX-License-Identifier: BSD-3-Clause
#include "map_file/landmarks_section.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ardrone_vslam {
namespace {

constexpr std::int64_t kMillisecond_ns = 1'000'000;

/// Whether a float can have it.
bool fits(double value) {
  return std::abs(value) <= std::numeric_limits<float>::max();
}

bool isNonNegative(double value) {
  return value >= 0 && fits(value);
}

bool hasCovariance(const Symmetric3& covariance) {
  const auto& [xx, xy, xz, yy, yz, zz] = covariance.upper;
  return isNonNegative(xx) && isNonNegative(yy) && isNonNegative(zz) && fits(xy) && fits(xz) &&
         fits(yz);
}

bool hasUnitLength(const Eigen::Vector3f& direction) {
  constexpr double kTolerance = 1e-5;  // floats are off by 1e-7
  double squared = 0;
  for (int i = 0; i < 3; ++i) {
    if (!(std::abs(direction[i]) < 2)) return false;
    squared += double{direction[i]} * direction[i];
  }
  return std::abs(squared - 1) < 2 * kTolerance;
}

/// Milliseconds before `now_ns`: 0 for what comes after it, the greatest number for what is older
/// than seven weeks.
std::uint32_t age_ms(std::int64_t now_ns, std::int64_t then_ns) {
  if (then_ns >= now_ns) return 0;
  // Unsigned, so that no difference is too large.
  const std::uint64_t age_ns =
      static_cast<std::uint64_t>(now_ns) - static_cast<std::uint64_t>(then_ns);
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max();
  return static_cast<std::uint32_t>(std::min(age_ns / std::uint64_t{kMillisecond_ns}, kMost));
}

std::uint32_t savedCount(int count) {
  return static_cast<std::uint32_t>(std::max(count, 0));
}

int loadedCount(std::uint32_t count) {
  constexpr auto kMost = static_cast<std::uint32_t>(std::numeric_limits<int>::max());
  return count > kMost ? -1 : static_cast<int>(count);
}

constexpr std::uint32_t kRecordsAtOnce = 400;
constexpr std::size_t kCountSize = 4;  // bytes, before the records

std::uint32_t readCount(const MapFileInput& file, const MapSection& section) {
  std::array<std::uint8_t, kCountSize> bytes{};
  if (section.size >= kCountSize) file.read(section.offset, bytes.data(), bytes.size());
  const auto count = fromLittleEndian<std::uint32_t>(bytes.data());
  if (section.size != kCountSize + std::uint64_t{kLandmarkRecord} * count)
    refuseSection(kLandmarksTag, "its size does not fit its number of landmarks");
  return count;
}

/// Fills in what is in a file; the rest stays as it is. A count that is too large for a Landmark
/// becomes -1, which is a fault.
void readLandmark(std::int64_t stamp_ns, ByteReader& in, Landmark& l) {
  for (std::uint64_t& word : l.descriptor.words) word = in.u64();
  for (int i = 0; i < 3; ++i) l.position_map[i] = in.f64();
  for (double& value : l.covariance_m2.upper) value = in.f32();
  for (int i = 0; i < 3; ++i) l.view_direction_map[i] = in.f32();
  for (float* value : {&l.seen_distance_m, &l.sigma_m, &l.depth_sigma_m, &l.parallax_rad})
    *value = in.f32();
  const std::uint32_t anchor = in.u32();
  // The greatest index would come round to 0, which no landmark has: a fault as well.
  l.anchor_id = anchor + 1;
  l.times_seen = loadedCount(in.u32());
  l.times_failed = loadedCount(in.u32());
  l.first_seen_ns = stamp_ns - kMillisecond_ns * std::int64_t{in.u32()};
  l.last_seen_ns = stamp_ns - kMillisecond_ns * std::int64_t{in.u32()};
}

/// Takes the next landmark.
void take(ByteReader& in, SavedMap& map) {
  Landmark& landmark = map.landmarks.emplace_back();
  landmark.id = static_cast<std::uint32_t>(map.landmarks.size());
  readLandmark(map.stamp_ns, in, landmark);
  const char* fault = landmarkFault(landmark, map.anchors.size());
  if (fault == nullptr && (landmark.times_seen < 0 || landmark.times_failed < 0))
    fault = "has a count that is too large";
  if (fault != nullptr)
    refuseSection(kLandmarksTag, "landmark " + std::to_string(landmark.id) + " " + fault);
}

}  // namespace

const char* landmarkFault(const Landmark& l, std::size_t anchors) {
  if (l.anchor_id == 0 || l.anchor_id > anchors) return "belongs to an anchor that is not there";
  if (!l.position_map.allFinite()) return "has a position that is not finite";
  if (!hasCovariance(l.covariance_m2))
    return "has a covariance that is not finite or has a negative variance";
  if (!hasUnitLength(l.view_direction_map)) return "has a view direction of another length than 1";
  if (!isNonNegative(l.seen_distance_m) || !isNonNegative(l.sigma_m) ||
      !isNonNegative(l.depth_sigma_m) || !isNonNegative(l.parallax_rad))
    return "has a distance, sigma or parallax that is negative or not finite";
  return nullptr;
}

void writeLandmark(const Landmark& l, std::int64_t stamp_ns, ByteWriter& out) {
  for (const std::uint64_t word : l.descriptor.words) out.u64(word);
  for (int i = 0; i < 3; ++i) out.f64(l.position_map[i]);
  for (const double value : l.covariance_m2.upper) out.f32(static_cast<float>(value));
  for (int i = 0; i < 3; ++i) out.f32(l.view_direction_map[i]);
  for (const float value : {l.seen_distance_m, l.sigma_m, l.depth_sigma_m, l.parallax_rad})
    out.f32(value);
  out.u32(l.anchor_id - 1);
  out.u32(savedCount(l.times_seen));
  out.u32(savedCount(l.times_failed));
  out.u32(age_ms(stamp_ns, l.first_seen_ns));
  out.u32(age_ms(stamp_ns, l.last_seen_ns));
}

void readLandmarks(const MapFileInput& file, const MapSection& section, SavedMap& map) {
  std::uint32_t left = readCount(file, section);
  map.landmarks.reserve(left);
  std::vector<std::uint8_t> bytes(kLandmarkRecord * std::min(left, kRecordsAtOnce));
  std::uint64_t offset = section.offset + kCountSize;
  while (left > 0) {
    const std::uint32_t count = std::min(left, kRecordsAtOnce);
    const std::size_t size = kLandmarkRecord * count;
    file.read(offset, bytes.data(), size);
    ByteReader in(bytes.data(), size);
    for (std::uint32_t i = 0; i < count; ++i) take(in, map);
    offset += size;
    left -= count;
  }
}

}  // namespace ardrone_vslam
