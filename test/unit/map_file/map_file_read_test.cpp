// SPDX-License-Identifier: BSD-3-Clause
// What a file consists of: bytes and sections.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>

#include "unit/map_file/map_file_read_fixture.hpp"

namespace ardrone_vslam::test {
namespace {

constexpr std::size_t kInfoSection = 0;

TEST_F(MapFileReadTest, TheHelpersPutTheFileTogetherAsItWas) {
  EXPECT_TRUE(fileOf(sections_) == bytes_);
}

TEST_F(MapFileReadTest, EveryLengthButTheWholeIsRefused) {
  for (std::size_t length = 0; length < bytes_.size(); ++length)
    ASSERT_NE(faultOfBytes(bytes_.substr(0, length)), "") << length << " bytes";
  EXPECT_NE(faultOfBytes(bytes_ + '\0'), "");
  EXPECT_NE(faultOfBytes(bytes_ + bytes_), "");
}

TEST_F(MapFileReadTest, EveryByteThatIsAnotherIsNoticed) {
  for (std::size_t at = 0; at < bytes_.size(); ++at) {
    for (const int change : {0x01, 0x20, 0x80, 0xFF}) {
      std::string bytes = bytes_;
      bytes[at] = static_cast<char>(bytes[at] ^ change);
      ASSERT_NE(faultOfBytes(bytes), "") << "byte " << at << " changed by " << change;
    }
  }
}

TEST_F(MapFileReadTest, SaysWhatIsDamaged) {
  std::string bytes = bytes_;
  bytes[bytes.size() - 100] ^= 1;
  writeFile(path_, bytes);
  EXPECT_EQ(faultOf(path_), path_ +
                                ": section LAND is damaged (its check sum does not fit); use "
                                "another copy");
  EXPECT_EQ(faultOfBytes(bytes_.substr(0, 200)),
            "the file is cut short, or damaged: it ends within section ANCH; use another copy");
  EXPECT_EQ(faultOfBytes(""), "the file ends after 0 bytes, too few for a map; use another copy");
  EXPECT_EQ(faultOfBytes("id,x_m,y_m,z_m,sigma_m,depth_sigma_m,times_seen\n"),
            "this is no map file (it does not begin with VSLAMMAP); name one that was saved as a "
            "map");
}

TEST_F(MapFileReadTest, WhatIsNoFileIsRefusedByNameAtOnce) {
  const std::string pipe = folder_.file("pipe");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(faultOf(pipe), pipe + ": this is a pipe; name a map file");
  EXPECT_EQ(faultOf("/dev/zero"), "/dev/zero: this is a device; name a map file");
  EXPECT_EQ(faultOf(folder_.path()), folder_.path() + ": this is a folder; name a map file");
  const std::string none = folder_.file("none.vmap");
  EXPECT_EQ(faultOf(none), none +
                               ": the map cannot be read: No such file or directory; check the "
                               "path; its folder must be there");
}

TEST_F(MapFileReadTest, MoreThanTwoGibibytesAreNotRead) {
  std::filesystem::resize_file(path_, (std::uintmax_t{1} << 31U) + 1);  // takes no room
  EXPECT_NE(faultOf(path_).find("the file is larger than 2 GiB"), std::string::npos);
}

TEST_F(MapFileReadTest, ANewerSchemaIsRefusedByName) {
  const std::string newer = headerOf(5, 2) + bytes_.substr(kMapHeaderSize);
  EXPECT_EQ(faultOfBytes(newer),
            "the map was written by a newer version (schema 2, this one knows "
            "up to 1); use a newer version of ardrone_vslam");
  EXPECT_NE(faultOfBytes(headerOf(5, 0) + bytes_.substr(kMapHeaderSize)), "");
}

TEST_F(MapFileReadTest, SaysWhoMadeTheFileIfThatWasTold) {
  EXPECT_EQ(readMap(path_).made_by, "");
  writeMap(path_, smallMap(), "replay 0.2.0");
  EXPECT_EQ(readMap(path_).made_by, "replay 0.2.0");
  auto sections = sectionsOf(readFile(path_));
  sections[2].payload.back() = '\n';
  EXPECT_EQ(faultOfSections(sections),
            "section made cannot be right: the name of the program that made the map (replay "
            "0.2.?) has characters that cannot be printed; use another copy, or make the map anew");
  sections[2].payload += '!';
  EXPECT_NE(faultOfSections(sections).find("its size does not fit"), std::string::npos);
  writeMap(path_, smallMap(), std::string(256, 'x'));
  EXPECT_TRUE(readFile(path_) == bytes_) << "too long a name is left out";
}

TEST_F(MapFileReadTest, OtherDescriptorsAreRefusedByName) {
  auto sections = sections_;
  ByteWriter info;
  info.text("ORB-256");
  sections[kInfoSection].payload.replace(0, 13, bytesOf(info));
  EXPECT_EQ(faultOfSections(sections),
            "its landmarks have descriptors of the kind \"ORB-256\", not \"FREAK-512\"; make the "
            "map anew");
}

TEST_F(MapFileReadTest, SectionsOfNewerVersionsAreSkippedOnlyIfTheySaySo) {
  auto sections = sections_;
  sections.insert(sections.begin() + 1, 2, {"note", "whatever"});
  EXPECT_EQ(faultOfSections(sections), "");
  EXPECT_EQ(readMap(path_).landmarks.size(), 3U);
  sections[1].tag = "Note";
  EXPECT_EQ(faultOfSections(sections),
            "the map has a section Note that this version does not know and may not skip; use a "
            "newer version of ardrone_vslam");
  sections[1].tag = "\1\xFFx\n";
  EXPECT_NE(faultOfSections(sections).find("a section ??x? that"), std::string::npos);
}

TEST_F(MapFileReadTest, SectionsMayComeInAnyOrderButOnceEach) {
  auto sections = sections_;
  std::reverse(sections.begin(), sections.end());
  EXPECT_EQ(faultOfSections(sections), "");
  for (std::size_t i = 0; i < sections_.size(); ++i) {
    sections = sections_;
    sections.erase(sections.begin() + static_cast<std::ptrdiff_t>(i));
    EXPECT_EQ(faultOfSections(sections),
              "the file is damaged: section " + sections_[i].tag + " is missing; use another copy");
    sections = sections_;
    sections.push_back(sections_[i]);
    EXPECT_EQ(faultOfSections(sections),
              "section " + sections_[i].tag + " is there twice; use another copy");
  }
  EXPECT_NE(faultOfBytes(headerOf(4) + joined(sections_)).find("section DONE is missing"),
            std::string::npos);
  const std::string end = bytes_.substr(bytes_.size() - kSectionFrame - 8);
  EXPECT_NE(faultOfBytes(headerOf(6) + bytes_.substr(kMapHeaderSize) + joined({{"note", ""}}))
                .find("it goes on behind its last section"),
            std::string::npos);
  EXPECT_EQ(faultOfBytes(headerOf(6) + joined({{"note", ""}}) + joined(sections_) + end),
            "the file has another size than it was written with; use another copy");
}

}  // namespace
}  // namespace ardrone_vslam::test
