// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <new>

#include "map_file/flight_section.hpp"
#include "map_file/landmarks_section.hpp"
#include "map_file/map_file_output.hpp"

namespace ardrone_vslam {
namespace {

/// A section that is made in one piece.
struct SmallSection {
  SectionTag tag;
  ByteWriter payload;
};

/// Sizes of all sections, which stand before their contents.
struct Layout {
  SmallSection info{kInfoTag, {}};
  SmallSection cameras{kCameraTag, {}};
  SmallSection made{kMadeTag, {}};  // without bytes: none
  std::uint64_t anchors = 0;
  std::uint64_t landmarks = 0;
  std::uint64_t flight = 0;  // none
  static constexpr std::uint64_t kEnd = 8;

  bool hasMade() const { return made.payload.size() > 0; }
  std::uint32_t sections() const { return 5U + (hasMade() ? 1U : 0U) + (flight > 0 ? 1U : 0U); }
  std::uint64_t fileSize() const {
    return kMapHeaderSize + sections() * kSectionFrame + info.payload.size() +
           cameras.payload.size() + made.payload.size() + anchors + landmarks + flight + kEnd;
  }
};

/// @return the fault, and what helps
std::string mapFault(const SavedMap& map) {
  std::string fault = camerasFault(map.cameras);
  if (!fault.empty()) return fault;
  fault = infoFault(map);
  if (fault.empty()) fault = anchorsFault(map);
  return fault.empty() ? fault : fault + "; make the map anew";
}

bool isSavable(const Landmark& landmark, const SavedMap& map) {
  return landmarkFault(landmark, map.anchors.size()) == nullptr;
}

/// Their ids.
std::vector<std::uint32_t> savableLandmarks(const SavedMap& map) {
  std::vector<std::uint32_t> ids;
  ids.reserve(map.landmarks.size());
  for (const Landmark& landmark : map.landmarks) {
    if (isSavable(landmark, map)) ids.push_back(landmark.id);
  }
  return ids;
}

Layout layoutOf(const SavedMap& map, std::size_t landmarks, const std::string& made_by) {
  Layout layout;
  if (madeFault(made_by).empty()) layout.made.payload.text(made_by);
  writeInfo(map, layout.info.payload);
  writeCameras(map.cameras, layout.cameras.payload);
  layout.anchors = anchorsSize(map.anchors.size());
  layout.landmarks = 4 + std::uint64_t{kLandmarkRecord} * landmarks;
  if (!map.flight.keyframes.empty() && flightFault(map.flight).empty())
    layout.flight = flightSize(map.flight);
  if (layout.fileSize() > kMostMapBytes) layout.flight = 0;
  return layout;
}

void writeSmall(const SmallSection& section, MapFileOutput& file) {
  file.begin(section.tag, section.payload.size());
  file.buffer().append(section.payload);
  file.end();
}

void writeAnchorsSection(const SavedMap& map, std::uint64_t size, MapFileOutput& file) {
  file.begin(kAnchorsTag, size);
  writeAnchors(map.anchors, file.buffer());
  for (Eigen::Index row = 0; row < map.anchor_covariance.rows(); ++row) {
    writeCovarianceRow(map.anchor_covariance, row, file.buffer());
    file.pass();
  }
  file.end();
}

void writeLandmarksSection(const SavedMap& map, std::size_t count, std::uint64_t size,
                           MapFileOutput& file) {
  file.begin(kLandmarksTag, size);
  file.buffer().u32(static_cast<std::uint32_t>(count));
  for (const Landmark& landmark : map.landmarks) {
    if (!isSavable(landmark, map)) continue;
    writeLandmark(landmark, map.stamp_ns, file.buffer());
    file.pass();
  }
  file.end();
}

void writeFlightSection(const FlightRecord& flight, const std::vector<std::uint32_t>& landmarks,
                        std::uint64_t size, MapFileOutput& file) {
  LandmarkNumbers numbers(landmarks);
  file.begin(kFlightTag, size);
  writeFlightHead(flight, file.buffer());
  for (const Keyframe& keyframe : flight.keyframes) {
    writeKeyframe(keyframe, numbers, file.buffer());
    file.pass();
  }
  writeFlightTail(flight, file.buffer());
  file.end();
}

/// @throws std::bad_alloc too
std::size_t writeAll(const std::string& path, const SavedMap& map, const std::string& made_by) {
  const std::string fault = mapFault(map);
  if (!fault.empty())
    throw MapFileError(path + ": the map is not written, it could not be read again: " + fault);
  const std::vector<std::uint32_t> landmarks = savableLandmarks(map);
  const std::size_t count = landmarks.size();
  const Layout layout = layoutOf(map, count, made_by);
  if (layout.fileSize() > kMostMapBytes)
    throw MapFileError(path + ": the map is not written, " + std::to_string(count) +
                       " landmarks would make more than 2 GiB; bound the map (max_landmarks)");
  MapFileOutput file(path);
  file.header(layout.sections());
  writeSmall(layout.info, file);
  writeSmall(layout.cameras, file);
  if (layout.hasMade()) writeSmall(layout.made, file);
  writeAnchorsSection(map, layout.anchors, file);
  writeLandmarksSection(map, count, layout.landmarks, file);
  if (layout.flight > 0) writeFlightSection(map.flight, landmarks, layout.flight, file);
  file.begin(kEndTag, Layout::kEnd);
  file.buffer().u64(layout.fileSize());
  file.end();
  file.commit();
  return count;
}

}  // namespace

std::size_t writeMap(const std::string& path, const SavedMap& map, const std::string& made_by) {
  try {
    return writeAll(path, map, made_by);
  } catch (const std::bad_alloc&) {
    throw MapFileError(path + ": there is not enough memory to write the map; bound its anchors " +
                       "(max_anchors)");
  }
}

void checkWritable(const std::string& path) {
  const MapFileOutput output(path);
}

}  // namespace ardrone_vslam
