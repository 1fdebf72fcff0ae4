// SPDX-License-Identifier: BSD-3-Clause
// Map files: refused by name, or a map that can be written, comes back the same, and can be flown
// in.
#include <algorithm>

#include "ardrone_vslam/slam.hpp"
#include "fuzz/fuzz_input.hpp"
#include "support/point_flight.hpp"
#include "support/read_file.hpp"
#include "support/temporary_folder.hpp"
#include "unit/map_file/map_files.hpp"

namespace ardrone_vslam::fuzz {
namespace {

void writeNumber(std::uint8_t* to, std::uint64_t value, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) to[i] = static_cast<std::uint8_t>(value >> (8 * i));
}

std::string fileOfMap(const SavedMap& map, const TemporaryFolder& folder) {
  writeMap(folder.file("seed.vmap"), map, "fuzz 1");
  return test::readFile(folder.file("seed.vmap"));
}

void requireUsable(const SavedMap& map, const TemporaryFolder& folder) {
  const std::string first = folder.file("first.vmap");
  const std::string second = folder.file("second.vmap");
  require(writeMap(first, map, map.made_by) == map.landmarks.size(),
          "all landmarks that were read are written");
  const SavedMap again = readMap(first, WithFlight::kYes);
  require(writeMap(second, again, again.made_by) == map.landmarks.size(), "and come back");
  require(test::readFile(first) == test::readFile(second), "a map comes back as it was written");
}

/// Frames of a flight that knows nothing of the map.
void requireFlyable(const SavedMap& map) {
  static const test::Flight flight = test::lapsFlight(test::kLapFrames, 1, 10);
  static const std::vector<ImageFeatures> frames = [] {
    PointWorld world(1);
    world.addRoom({10, 8, 3}, 60);
    return test::film(world, {flight.begin(), flight.begin() + 3});
  }();
  static const std::vector<OdometryState> odometry = test::observeExactly(flight);
  Slam slam(SlamConfig{}, test::forwardExtrinsics());
  slam.load(map);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const FrameResult& result = slam.process(frames[i], odometry[i]);
    require(result.T_map_base.matrix().allFinite() && result.covariance.allFinite(),
            "in a map that was read every pose is finite");
  }
}

}  // namespace

std::vector<Bytes> seeds() {
  const TemporaryFolder folder;
  RandomSource random(1);
  std::vector<Bytes> all{bytesOf(fileOfMap(test::smallMap(), folder)),
                         bytesOf(test::fileOf({{"INFO", ""}, {"extr", "to be skipped"}}))};
  SavedMap with_flight = test::smallMap();
  with_flight.flight = test::smallFlight();
  all.push_back(bytesOf(fileOfMap(with_flight, folder)));
  with_flight.flight.config.odometry.extrinsics_sigma_deg = 0.25;
  all.push_back(bytesOf(fileOfMap(with_flight, folder)));
  for (int i = 0; i < 4; ++i)
    all.push_back(bytesOf(fileOfMap(test::randomMap(random, 2, 3), folder)));
  return all;
}

/// The sections' check sums and number, and the file's size in the last one.
std::size_t repair(std::uint8_t* data, std::size_t size, std::size_t /*most_size*/) {
  if (size < kMapHeaderSize) return size;
  std::uint32_t sections = 0;
  std::size_t at = kMapHeaderSize;
  while (size - at >= kSectionFrame) {
    std::uint8_t* const section = data + at;
    const std::size_t room = size - at - kSectionFrame;
    // One that says more than there is ends with the file.
    const std::size_t payload = std::min<std::size_t>(
        static_cast<std::size_t>(fromLittleEndian<std::uint64_t>(section + 4)), room);
    writeNumber(section + 4, payload, 8);
    if (std::equal(kEndTag.begin(), kEndTag.end(), section) && payload == 8)
      writeNumber(section + 12, size, 8);
    Crc32 crc;
    crc.add(section, 12 + payload);
    writeNumber(section + 12 + payload, crc.value(), 4);
    at += kSectionFrame + payload;
    ++sections;
  }
  std::copy_n(kMapMagic, kMapMagicSize, data);
  writeNumber(data + kMapMagicSize, kMapSchema, 4);
  writeNumber(data + kMapMagicSize + 4, sections, 4);
  return size;
}

}  // namespace ardrone_vslam::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ardrone_vslam;
  static const TemporaryFolder folder;
  const std::string path = folder.file("house.vmap");
  folder.write("house.vmap", {data, data + size});
  try {
    const SavedMap map = readMap(path, WithFlight::kYes);
    fuzz::requireUsable(map, folder);
    fuzz::requireFlyable(map);
  } catch (const MapFileError& error) {
    fuzz::require(std::string(error.what()).rfind(path + ": ", 0) == 0, "errors name the file");
  }
  return 0;
}
