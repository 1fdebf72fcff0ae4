// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdio>
#include <string>

#include "map_file/crc32.hpp"
#include "map_file/map_sections.hpp"

namespace ardrone_vslam {

/// A map file being written beside the one that it will replace. Without commit() nothing remains
/// of it. Each function throws MapFileError when the file system refuses, with the path.
class MapFileOutput {
 public:
  /// Begins an empty file.
  explicit MapFileOutput(const std::string& path);
  ~MapFileOutput();
  MapFileOutput(const MapFileOutput&) = delete;
  MapFileOutput& operator=(const MapFileOutput&) = delete;

  /// What stands before all sections.
  void header(std::uint32_t sections);
  /// Begins a section with so many bytes.
  void begin(const SectionTag& tag, std::uint64_t size);
  /// Room for the section's next bytes: put them in, then call pass().
  ByteWriter& buffer() { return buffer_; }
  /// Writes what is in the buffer when that is enough to be worth it.
  void pass();
  /// Ends the section. @pre it has the size that begin() said
  void end();

  /// Ends the file, makes sure that it is on the disk and gives it its name.
  void commit();

 private:
  void flush();
  void syncFolder();
  [[noreturn]] void fail(int error);

  std::string path_;
  std::string part_;
  std::FILE* file_ = nullptr;
  ByteWriter buffer_;
  Crc32 crc_;
};

}  // namespace ardrone_vslam
