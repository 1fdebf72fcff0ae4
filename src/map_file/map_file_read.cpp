// SPDX-License-Identifier: BSD-3-Clause
#include <new>

#include "map_file/flight_section.hpp"
#include "map_file/landmarks_section.hpp"

namespace ardrone_vslam {
namespace {

std::vector<std::uint8_t> bytesOf(const MapFileInput& file, const MapSection& section) {
  std::vector<std::uint8_t> bytes(section.size);
  file.read(section.offset, bytes.data(), bytes.size());
  return bytes;
}

/// @throws MapFileError that does not name the file
SavedMap readUnnamed(const std::string& path, WithFlight with_flight) {
  const MapFileInput file(path);
  const SectionTable table(file);
  SavedMap map;
  const auto read = [&](const SectionTag& tag, void (*part)(ByteReader, SavedMap&)) {
    const std::vector<std::uint8_t> bytes = bytesOf(file, table.find(tag));
    part({bytes.data(), bytes.size()}, map);
  };
  read(kInfoTag, readInfo);
  read(kCameraTag, readCameras);
  read(kAnchorsTag, readAnchors);
  readLandmarks(file, table.find(kLandmarksTag), map);
  if (table.search(kMadeTag) != nullptr) read(kMadeTag, readMade);
  if (with_flight == WithFlight::kYes && table.search(kFlightTag) != nullptr)
    read(kFlightTag, readFlight);
  return map;
}

}  // namespace

SavedMap readMap(const std::string& path, WithFlight with_flight) {
  try {
    return readUnnamed(path, with_flight);
  } catch (const MapFileError& error) {
    throw MapFileError(path + ": " + error.what());
  } catch (const std::bad_alloc&) {
    throw MapFileError(path +
                       ": there is not enough memory for the map; use a machine with more, or give "
                       "it more (vslam_onboard: working_mb)");
  }
}

}  // namespace ardrone_vslam
