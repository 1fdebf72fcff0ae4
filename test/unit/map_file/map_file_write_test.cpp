// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>

#include "support/file_size_limit.hpp"
#include "support/read_file.hpp"
#include "support/small_disk.hpp"
#include "support/temporary_folder.hpp"
#include "unit/map_file/map_files.hpp"

namespace ardrone_vslam::test {
namespace {

namespace fs = std::filesystem;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

class MapFileWriteTest : public ::testing::Test {
 protected:
  /// What writing the map is refused with.
  std::string writeFault(const SavedMap& map) const { return writeFault(map, path_); }
  static std::string writeFault(const SavedMap& map, const std::string& path) {
    try {
      writeMap(path, map);
    } catch (const MapFileError& error) {
      return error.what();
    }
    return "";
  }
  std::size_t filesInFolder() const {
    const fs::directory_iterator files(folder_.path());
    return static_cast<std::size_t>(std::distance(begin(files), end(files)));
  }

  TemporaryFolder folder_;
  std::string path_ = folder_.file("house.vmap");
};

TEST_F(MapFileWriteTest, AMapIsOfAllCamerasThatSawIt) {
  SavedMap map = smallMap();
  addCamera({640, 360, 561.5}, map.cameras);
  addCamera({640, 360, 561.5 * 1.049}, map.cameras);
  EXPECT_EQ(map.cameras.size(), 1U) << "another calibration";
  addCamera({320, 240, 270}, map.cameras);
  writeMap(path_, map);
  const std::vector<MapCamera> cameras = readMap(path_).cameras;
  ASSERT_EQ(cameras.size(), 2U);
  EXPECT_EQ(cameraDifference(cameras, {640, 360, 561.5 / 1.049}), "");
  EXPECT_EQ(cameraDifference(cameras, {320, 240, 270}), "");
  EXPECT_NE(cameraDifference(cameras, {640, 240, 270})
                .find("another camera (640 x 360 px, focal length 561.5 px or 320 x 240 px, focal "
                      "length 270 px; now 640 x 240 px, focal length 270 px)"),
            std::string::npos);
}

TEST_F(MapFileWriteTest, NothingElseIsLeftInTheFolder) {
  folder_.write("house.vmap.part", "of a flight that ended early");
  EXPECT_EQ(writeMap(path_, smallMap()), 3U);
  EXPECT_EQ(filesInFolder(), 1U);
  EXPECT_EQ(readMap(path_).landmarks.size(), 3U);
}

TEST_F(MapFileWriteTest, TheOldMapStaysWhenTheDiskIsFull) {
  writeMap(path_, smallMap());
  const std::string old = readFile(path_);
  SavedMap larger = smallMap();
  larger.landmarks.resize(5000, larger.landmarks[0]);
  for (rlim_t bytes = 0; bytes < 800'000; bytes += 4'000) {
    std::string fault;
    {
      const FileSizeLimit full(bytes);
      fault = writeFault(larger);
    }
    EXPECT_EQ(fault, path_ +
                         ": the map cannot be written: File too large; make room, or choose "
                         "another disk");
    EXPECT_TRUE(readFile(path_) == old) << "the old map changed";
    EXPECT_EQ(filesInFolder(), 1U);
  }
}

TEST_F(MapFileWriteTest, TheOldMapOrTheNewOneIsThereAfterAKill) {
  SavedMap map = smallMap();
  map.landmarks.resize(2000, map.landmarks[0]);
  const auto save = [&] {
    ++map.stamp_ns;
    const pid_t writer = ::fork();
    if (writer == 0) ::_exit(writeFault(map).empty() ? 0 : 1);
    return writer;
  };
  const auto began = std::chrono::steady_clock::now();
  ASSERT_EQ(::waitpid(save(), nullptr, 0) > 0, true);
  const std::chrono::duration<double, std::micro> whole_us =
      std::chrono::steady_clock::now() - began;
  constexpr int kSaves = 200;
  int killed = 0;
  int parts_left = 0;
  for (int i = 0; i < kSaves; ++i) {
    const pid_t writer = save();
    ::usleep(static_cast<useconds_t>(2 * whole_us.count() * i / kSaves));
    ::kill(writer, SIGKILL);
    int status = 0;
    ASSERT_EQ(::waitpid(writer, &status, 0), writer);
    killed += WIFSIGNALED(status) ? 1 : 0;
    parts_left += fs::exists(path_ + ".part") ? 1 : 0;
    const SavedMap found = readMap(path_);
    ASSERT_EQ(found.landmarks.size(), 2000U) << i;
    ASSERT_LE(found.stamp_ns, map.stamp_ns) << i;
    if (!WIFSIGNALED(status)) {
      ASSERT_EQ(found.stamp_ns, map.stamp_ns) << i;
    }
  }
  std::printf("%d of %d saves were killed, %d of them while they wrote\n", killed, kSaves,
              parts_left);
  EXPECT_GT(killed, 0);
  EXPECT_LT(killed, kSaves);
  EXPECT_GT(parts_left, 0) << "no save was killed while it wrote";
  writeMap(path_, map);
  EXPECT_EQ(filesInFolder(), 1U) << "what a killed save leaves goes with the next one";
}

class MapFileFullDiskTest : public MapFileWriteTest {
 protected:
  static constexpr int kSaves = 200;

  /// On a disk that has room for some of the new map, most of the time. Every third writer is
  /// killed. @return whether the old or the new map was there each time
  bool saveOften() {
    std::mt19937 random(1);
    SavedMap map = smallMap();
    map.landmarks.resize(2000, map.landmarks[0]);  // 320,000 bytes
    writeMap(path_, map);
    std::int64_t before_ns = map.stamp_ns;
    for (int i = 0; i < kSaves; ++i) {
      std::ofstream(folder_.file("other")) << std::string(300'000 + random() % 450'000, 'x');
      ++map.stamp_ns;
      const int status = save(map, i % 3 == 0 ? static_cast<int>(random() % 3000) : -1);
      fs::remove(folder_.file("other"));
      const std::int64_t found_ns = readMap(path_).stamp_ns;
      if (!isAsItShould(status, found_ns == before_ns, found_ns == map.stamp_ns)) return false;
      before_ns = found_ns;
    }
    std::printf("of %d saves %d found the disk full, %d were killed, %d wrote the map\n", kSaves,
                full_, killed_, written_);
    std::fflush(stdout);
    return full_ > kSaves / 5 && killed_ > kSaves / 20 && written_ > kSaves / 10;
  }

 private:
  /// In a process of its own. @return its status
  int save(const SavedMap& map, int killed_after_us) const {
    const pid_t writer = ::fork();
    if (writer == 0) {
      const std::string fault = writeFault(map);
      if (fault.empty()) ::_exit(0);
      ::_exit(fault.find("No space left on device; make room") != std::string::npos ? 1 : 2);
    }
    if (killed_after_us >= 0) {
      ::usleep(static_cast<useconds_t>(killed_after_us));
      ::kill(writer, SIGKILL);
    }
    int status = -1;
    ::waitpid(writer, &status, 0);
    return status;
  }

  bool isAsItShould(int status, bool is_old, bool is_new) {
    if (WIFSIGNALED(status)) {
      ++killed_;
      return WTERMSIG(status) == SIGKILL && (is_old || is_new);
    }
    if (WEXITSTATUS(status) == 0) {
      ++written_;
      return is_new;
    }
    ++full_;
    return WEXITSTATUS(status) == 1 && is_old && filesInFolder() == 1;
  }

  int full_ = 0;
  int killed_ = 0;
  int written_ = 0;
};

TEST_F(MapFileFullDiskTest, TheOldMapOrTheNewOneIsThere) {
  constexpr int kDisk_bytes = 1 << 20;
  const int exit_code =
      onSmallDisk(folder_.path(), kDisk_bytes, [this] { return saveOften() ? 0 : 1; });
  if (exit_code == kNoDisk) GTEST_SKIP() << "this system lets nobody mount a disk";
  EXPECT_EQ(exit_code, 0);
}

TEST_F(MapFileWriteTest, WhatCannotBeAMapsFileIsToldBefore) {
  checkWritable(path_);
  EXPECT_EQ(filesInFolder(), 0U);
  writeMap(path_, smallMap());
  checkWritable(path_);
  EXPECT_EQ(faultOf(path_), "");
  EXPECT_THROW(checkWritable("/dev/null"), MapFileError);
  EXPECT_THROW(checkWritable(folder_.path()), MapFileError);
  EXPECT_THROW(checkWritable(folder_.file("no_folder/house.vmap")), MapFileError);
}

TEST_F(MapFileWriteTest, WhatIsNoFileIsNotReplaced) {
  EXPECT_EQ(writeFault(smallMap(), "/dev/null"),
            "/dev/null: this is a device; name a file for the map");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  fs::create_directory(path_);
  EXPECT_EQ(writeFault(smallMap()), path_ + ": this is a folder; name a file for the map");
}

TEST_F(MapFileWriteTest, ALinkInItsWayIsNotFollowed) {
  folder_.write("other", "text");
  fs::create_symlink(folder_.file("other"), path_ + ".part");
  writeMap(path_, smallMap());
  EXPECT_EQ(readFile(folder_.file("other")), "text");
  EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(path_)));
}

TEST_F(MapFileWriteTest, SaysWhatIsWrongWithThePath) {
  const std::string path = folder_.file("no_folder/house.vmap");
  EXPECT_EQ(writeFault(smallMap(), path), path +
                                              ": the map cannot be written: No such file or "
                                              "directory; check the path; its folder must be "
                                              "there");
  fs::create_directory(path_ + ".part");
  EXPECT_NE(writeFault(smallMap()).find("the map cannot be written"), std::string::npos);
}

TEST_F(MapFileWriteTest, AFileWithoutAFolderIsInThePresentOne) {
  const fs::path before = fs::current_path();
  fs::current_path(folder_.path());
  EXPECT_EQ(writeFault(smallMap(), "bare.vmap"), "");
  fs::current_path(before);
  EXPECT_EQ(faultOf(folder_.file("bare.vmap")), "");
}

TEST_F(MapFileWriteTest, LandmarksThatCannotBeReadAgainAreLeftOut) {
  SavedMap map = smallMap();
  map.landmarks.resize(12, map.landmarks[0]);
  map.landmarks[1].position_map.y() = kNan;
  map.landmarks[2].anchor_id = 3;
  map.landmarks[3].anchor_id = 0;
  Eigen::Matrix3d wrong_m2 = Eigen::Matrix3d::Identity();
  wrong_m2(0, 2) = 1e39;  // no float
  map.landmarks[4].covariance_m2 = -Eigen::Matrix3d::Identity();
  map.landmarks[5].covariance_m2 = wrong_m2;
  map.landmarks[6].view_direction_map.setZero();
  map.landmarks[7].view_direction_map.setConstant(static_cast<float>(kInf));
  map.landmarks[8].sigma_m = static_cast<float>(kNan);
  map.landmarks[9].seen_distance_m = -1;
  map.landmarks[10].depth_sigma_m = static_cast<float>(kInf);
  EXPECT_EQ(writeMap(path_, map), 2U);
  EXPECT_EQ(readMap(path_).landmarks.size(), 2U);
}

TEST_F(MapFileWriteTest, AgesAndCountsStayWithinTheirBounds) {
  SavedMap map = smallMap();
  map.stamp_ns = std::numeric_limits<std::int64_t>::max();
  map.landmarks[0].first_seen_ns = std::numeric_limits<std::int64_t>::min();
  map.landmarks[0].last_seen_ns = map.stamp_ns - 1'999'999;
  map.landmarks[0].times_seen = -1;
  map.landmarks[1].last_seen_ns = map.stamp_ns;
  writeMap(path_, map);
  const SavedMap loaded = readMap(path_);
  EXPECT_EQ(map.stamp_ns - loaded.landmarks[0].first_seen_ns, 0xFFFFFFFF * std::int64_t{1'000'000});
  EXPECT_EQ(map.stamp_ns - loaded.landmarks[0].last_seen_ns, 1'000'000);
  EXPECT_EQ(loaded.landmarks[0].times_seen, 0);
  EXPECT_EQ(loaded.landmarks[1].last_seen_ns, map.stamp_ns);
  map = smallMap();
  map.landmarks[0].last_seen_ns = map.stamp_ns + 5'000'000;
  writeMap(path_, map);
  EXPECT_EQ(readMap(path_).landmarks[0].last_seen_ns, map.stamp_ns);
}

TEST_F(MapFileWriteTest, AMapThatCouldNotBeReadAgainIsRefused) {
  using Change = void (*)(SavedMap&);
  const std::pair<Change, const char*> cases[] = {
      {[](SavedMap& m) { m.cameras[0].focal_length_px = kNan; },
       "the focal length is not positive"},
      {[](SavedMap& m) { m.cameras.clear(); }, "there is no camera"},
      {[](SavedMap& m) { m.cameras.resize(101, m.cameras[0]); }, "more than 100 cameras"},
      {[](SavedMap& m) { m.frame_id.clear(); }, "the name of the frame has 0 characters"},
      {[](SavedMap& m) { m.frame_id = "a\nb"; }, "the name of the frame (a?b)"},
      {[](SavedMap& m) { m.stamp_ns = -1; }, "the stamp is negative"},
      {[](SavedMap& m) { m.anchors.pop_back(); }, "the covariance of the anchors has another size"},
      {[](SavedMap& m) { m.anchor_covariance(8, 8) = -1e-9; }, "anchor 2 has a variance"},
      {[](SavedMap& m) { m.anchor_covariance(8, 8) = kInf; }, "anchor 2 has a variance"},
      {[](SavedMap& m) { m.anchor_covariance(8, 1) = 1; }, "not positive semidefinite"},
      {[](SavedMap& m) { m.anchor_covariance(8, 1) = kNan; }, "not positive semidefinite"},
      {[](SavedMap& m) { m.anchor_covariance(8, 8) = 0; }, "not positive semidefinite"},
      {[](SavedMap& m) { m.anchors[0].T_map_rig.translation().x() = kInf; },
       "anchor 1 has a pose that is not finite"},
      {[](SavedMap& m) { m.anchors[1].T_map_rig.linear() *= 1.1; },
       "anchor 2 has an attitude that is no rotation"},
      {[](SavedMap& m) { m.anchors[1].T_map_rig.linear().setConstant(1e300); },
       "anchor 2 has an attitude that is no rotation"},
      {[](SavedMap& m) { m.anchors[1].T_map_rig.linear() *= -1; },
       "anchor 2 has an attitude that is no rotation"},
      {[](SavedMap& m) { m.anchors.resize(1101); }, "there are 1101 anchors, at most 1100"}};
  for (const auto& [change, expected] : cases) {
    SavedMap map = smallMap();
    change(map);
    const std::string fault = writeFault(map);
    EXPECT_NE(fault.find(expected), std::string::npos) << expected << ": " << fault;
    EXPECT_EQ(filesInFolder(), 0U);
  }
}

}  // namespace
}  // namespace ardrone_vslam::test
