// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/read_file.hpp"
#include "support/temporary_folder.hpp"
#include "unit/map_file/map_files.hpp"

namespace ardrone_vslam::test {

/// The small map in a file, and its sections to be changed.
class MapFileReadTest : public ::testing::Test {
 protected:
  MapFileReadTest() {
    writeMap(path_, smallMap());
    bytes_ = readFile(path_);
    sections_ = sectionsOf(bytes_);
  }
  /// Of a file with these bytes, without its name.
  std::string faultOfBytes(const std::string& bytes) const {
    writeFile(path_, bytes);
    const std::string fault = faultOf(path_);
    return fault.empty() ? fault : fault.substr(path_.size() + 2);
  }
  std::string faultOfSections(const std::vector<RawSection>& sections) const {
    return faultOfBytes(fileOf(sections));
  }
  /// With other bytes at a place of one section, whose check sum fits.
  std::string faultOfChange(std::size_t section, std::size_t at, const ByteWriter& bytes) const {
    auto sections = sections_;
    sections.at(section).payload.replace(at, bytes.size(), bytesOf(bytes));
    return faultOfSections(sections);
  }

  TemporaryFolder folder_;
  std::string path_ = folder_.file("house.vmap");
  std::string bytes_;
  std::vector<RawSection> sections_;
};

}  // namespace ardrone_vslam::test
