// SPDX-License-Identifier: BSD-3-Clause
// Random maps come back as they were; random damage is refused or does no harm.
#include <gtest/gtest.h>

#include <limits>

#include "support/read_file.hpp"
#include "support/seeds.hpp"
#include "support/temporary_folder.hpp"
#include "unit/map_file/map_files.hpp"

namespace ardrone_vslam::test {
namespace {

void expectSame(const Landmark& a, const Landmark& b) {
  EXPECT_EQ(a.descriptor, b.descriptor);
  EXPECT_EQ(a.position_map, b.position_map);
  EXPECT_EQ(a.covariance_m2, b.covariance_m2);
  EXPECT_EQ(a.view_direction_map, b.view_direction_map);
  EXPECT_EQ(a.seen_distance_m, b.seen_distance_m);
  EXPECT_EQ(a.sigma_m, b.sigma_m);
  EXPECT_EQ(a.depth_sigma_m, b.depth_sigma_m);
  EXPECT_EQ(a.parallax_rad, b.parallax_rad);
  EXPECT_EQ(a.anchor_id, b.anchor_id);
  EXPECT_EQ(a.times_seen, b.times_seen);
  EXPECT_EQ(a.times_failed, b.times_failed);
  EXPECT_EQ(a.first_seen_ns, b.first_seen_ns);
  EXPECT_EQ(a.last_seen_ns, b.last_seen_ns);
}

void expectSame(const SavedMap& a, const SavedMap& b) {
  EXPECT_EQ(a.frame_id, b.frame_id);
  EXPECT_EQ(a.stamp_ns, b.stamp_ns);
  EXPECT_EQ(cameraDifference(a.camera, b.camera), "");
  EXPECT_EQ(a.camera.focal_length_px, b.camera.focal_length_px);
  EXPECT_EQ(a.anchor_covariance, b.anchor_covariance);
  ASSERT_EQ(a.anchors.size(), b.anchors.size());
  for (std::size_t i = 0; i < a.anchors.size(); ++i) {
    EXPECT_EQ(a.anchors[i].stamp_ns, b.anchors[i].stamp_ns);
    EXPECT_EQ(a.anchors[i].T_map_rig.translation(), b.anchors[i].T_map_rig.translation());
    EXPECT_TRUE(a.anchors[i].T_map_rig.isApprox(b.anchors[i].T_map_rig, 1e-12));
  }
  ASSERT_EQ(a.landmarks.size(), b.landmarks.size());
  for (std::size_t i = 0; i < a.landmarks.size(); ++i) expectSame(a.landmarks[i], b.landmarks[i]);
}

TEST(MapFileProperty, WhatIsReadIsWhatWasWrittenAndIsWrittenAsTheSameBytes) {
  const TemporaryFolder folder;
  const std::string first = folder.file("first.vmap");
  const std::string second = folder.file("second.vmap");
  for (const std::uint64_t seed : seeds()) {
    RandomSource random(seed);
    for (int i = 0; i < 30; ++i) {
      const SavedMap map = randomMap(random);
      ASSERT_EQ(writeMap(first, map), map.landmarks.size());
      const SavedMap loaded = readMap(first);
      expectSame(map, loaded);
      ASSERT_EQ(writeMap(second, loaded), loaded.landmarks.size());
      ASSERT_TRUE(readFile(second) == readFile(first)) << "seed " << seed << ", map " << i;
    }
  }
}

/// Numbers that are odd in one type or another.
std::string oddNumber(RandomSource& random) {
  const double odd[] = {0,
                        -0.0,
                        1,
                        -1,
                        1e-320,
                        1e300,
                        -1e300,
                        std::numeric_limits<double>::infinity(),
                        std::numeric_limits<double>::quiet_NaN()};
  const double value = odd[random.integer(0, 8)];
  ByteWriter bytes;
  switch (random.integer(0, 3)) {
    case 0:
      bytes.f64(value);
      break;
    case 1:
      bytes.f32(bitsAs<float>(static_cast<std::uint32_t>(random.integer(-5, 5)) << 23U));
      break;
    case 2:
      bytes.u32(static_cast<std::uint32_t>(random.integer(-3, 3)));
      break;
    default:
      bytes.i64(random.integer(-2, 2));
  }
  return bytesOf(bytes);
}

/// Does one thing to one section that no check sum tells of.
void damage(std::vector<RawSection>& sections, RandomSource& random) {
  const auto chosen =
      static_cast<std::size_t>(random.integer(0, static_cast<int>(sections.size()) - 1));
  std::string& payload = sections[chosen].payload;
  const auto at = static_cast<std::size_t>(random.integer(0, static_cast<int>(payload.size())));
  switch (random.integer(0, 7)) {
    case 0:
      payload.resize(at);
      break;
    case 1:
      payload.insert(at, oddNumber(random));
      break;
    case 2:
      sections.push_back(sections[chosen]);
      break;
    case 3:
      for (char& letter : sections[chosen].tag) {
        if (random.chance(0.25)) letter = static_cast<char>(letter ^ (1 << random.integer(0, 6)));
      }
      break;
    case 4:
    case 5:
      if (at < payload.size())
        payload[at] = static_cast<char>(payload[at] ^ (1 << random.integer(0, 7)));
      break;
    default: {
      const std::string number = oddNumber(random);
      // Where numbers begin, mostly.
      const std::size_t start = random.chance(0.8) ? at / 4 * 4 : at;
      if (start + number.size() <= payload.size()) payload.replace(start, number.size(), number);
    }
  }
}

/// A map that was taken can be written, and comes back as it is.
void expectUsable(const SavedMap& map, const TemporaryFolder& folder) {
  const std::string path = folder.file("again.vmap");
  ASSERT_EQ(writeMap(path, map), map.landmarks.size());
  const SavedMap again = readMap(path);
  expectSame(map, again);
}

TEST(MapFileProperty, DamageThatNoCheckSumTellsOfIsRefusedOrDoesNoHarm) {
  const TemporaryFolder folder;
  const std::string path = folder.file("house.vmap");
  constexpr int kUsedEvery = 20;  // writing waits for the disk
  std::vector<RawSection> whole;
  for (const std::uint64_t seed : seeds()) {
    RandomSource random(seed);
    int refused = 0;
    int loaded = 0;
    for (int i = 0; i < 2000; ++i) {
      if (i % 100 == 0) {
        writeMap(path, randomMap(random, 3, 4));
        whole = sectionsOf(readFile(path));
      }
      auto sections = whole;
      for (int n = random.integer(1, 3); n > 0; --n) damage(sections, random);
      writeFile(path, fileOf(sections));
      try {
        const SavedMap map = readMap(path);
        if (++loaded % kUsedEvery == 0) expectUsable(map, folder);
      } catch (const MapFileError& error) {
        ++refused;
        ASSERT_EQ(std::string(error.what()).find(path + ": "), 0U) << error.what();
      }
    }
    std::cout << "seed " << seed << ": " << refused << " refused, " << loaded << " loaded\n";
    EXPECT_GT(refused, 200);
    EXPECT_GT(loaded, 100);
  }
}

TEST(MapFileProperty, NoiseIsRefused) {
  const TemporaryFolder folder;
  const std::string path = folder.file("noise.vmap");
  for (const std::uint64_t seed : seeds()) {
    RandomSource random(seed);
    for (int i = 0; i < 500; ++i) {
      std::string bytes = random.chance(0.5) ? headerOf(5) : "";
      for (int n = random.integer(0, 200); n > 0; --n)
        bytes += static_cast<char>(random.integer(-128, 127));
      writeFile(path, bytes);
      ASSERT_NE(faultOf(path), "");
    }
  }
}

}  // namespace
}  // namespace ardrone_vslam::test
