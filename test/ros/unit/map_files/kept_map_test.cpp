// SPDX-License-Identifier: BSD-3-Clause
#include "map_files/kept_map.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "files/set_aside.hpp"
#include "support/read_file.hpp"
#include "support/temporary_folder.hpp"

namespace ardrone_vslam {
namespace {

namespace fs = std::filesystem;

MapSnapshot mapUntil(std::int64_t stamp_ns) {
  SavedMap map;
  map.frame_id = "map";
  map.cameras = {{640, 360, 500}};
  map.stamp_ns = stamp_ns;
  return MapSnapshot(std::move(map));
}

class KeptMapTest : public ::testing::Test {
 protected:
  /// SavedMap::stamp_ns of a file.
  std::int64_t stampIn(const std::string& ending = "") { return readMap(path_ + ending).stamp_ns; }

  TemporaryFolder folder_;
  std::string path_ = folder_.file("kept.vmap");
};

TEST_F(KeptMapTest, TheFileHasTheNewestOfOneMap) {
  KeptMap kept(path_, "test");
  kept.keep(mapUntil(5), kept.number());
  kept.keep(mapUntil(7), kept.number());
  EXPECT_EQ(stampIn(), 7);
  EXPECT_FALSE(fs::exists(path_ + ".before"));
}

TEST_F(KeptMapTest, WhatAnEarlierMapLeftGoesOnOnce) {
  KeptMap(path_, "test").keep(mapUntil(3), 1);
  KeptMap kept(path_, "test");
  for (const std::int64_t stamp_ns : {5, 7}) kept.keep(mapUntil(stamp_ns), kept.number());
  EXPECT_EQ(stampIn(".before"), 3);
  kept.beginAnew();
  kept.keep(mapUntil(7), kept.number());
  EXPECT_EQ(stampIn(".before"), 7) << "the stamp alone does not tell the maps apart";
}

TEST_F(KeptMapTest, AMapThatEndsWhileItIsWrittenGoesOn) {
  KeptMap kept(path_, "test");
  const int number = kept.number();
  kept.beginAnew();  // after the snapshot
  kept.keep(mapUntil(5), number);
  kept.keep(mapUntil(2), kept.number());
  EXPECT_EQ(stampIn(), 2);
  EXPECT_EQ(stampIn(".before"), 5);
}

TEST_F(KeptMapTest, NothingIsWrittenOverWhatCannotGoOn) {
  KeptMap(path_, "test").keep(mapUntil(3), 1);
  fs::create_directories(path_ + ".before/full");
  KeptMap kept(path_, "test");
  EXPECT_THROW(kept.keep(mapUntil(5), kept.number()), MapFileError);
  EXPECT_EQ(stampIn(), 3);
}

TEST_F(KeptMapTest, ItIsDueAfterItsPeriodAndNeverWithoutOne) {
  KeptMap kept(path_, "test");
  EXPECT_FALSE(kept.isDue());
  kept.setPeriod(1e-9);
  EXPECT_TRUE(kept.isDue());
  kept.setPeriod(3600);
  EXPECT_FALSE(kept.isDue());
}

TEST_F(KeptMapTest, AFileIsSetAsideAsItIsAndStays) {
  EXPECT_EQ(setAside(path_), "") << "there is none";
  for (const char* text : {"one", "two"}) {
    fs::remove(path_);  // as writeMap() replaces it: else the link would be changed, too
    std::ofstream(path_) << text;
    EXPECT_EQ(setAside(path_), "");
    EXPECT_EQ(test::readFile(path_), text);
    EXPECT_EQ(test::readFile(path_ + ".before"), text);
  }
  EXPECT_FALSE(fs::exists(path_ + ".before.part"));
}

TEST_F(KeptMapTest, WhatAKilledRunLeftIsNoHindrance) {
  std::ofstream(path_) << "one";
  std::ofstream(path_ + ".before.part") << "half";
  EXPECT_EQ(setAside(path_), "");
  EXPECT_EQ(test::readFile(path_ + ".before"), "one");
}

}  // namespace
}  // namespace ardrone_vslam
