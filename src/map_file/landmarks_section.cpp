// SPDX-License-Identifier: BSD-3-Clause
#include "map_file/landmarks_section.hpp"

#include <algorithm>

#include "map_file/landmark_record.hpp"

namespace ardrone_vslam {
namespace {

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
