// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace ardrone_vslam {

/// A file being read that has the size of a map file. What fails throws MapFileError without the
/// file's name.
class MapFileInput {
 public:
  /// Opens a regular file; what is none is not even opened.
  explicit MapFileInput(const std::string& path);
  ~MapFileInput();
  MapFileInput(const MapFileInput&) = delete;
  MapFileInput& operator=(const MapFileInput&) = delete;

  std::uint64_t size() const { return size_; }
  /// The bytes from `offset` on. @pre there are so many
  void read(std::uint64_t offset, std::uint8_t* bytes, std::size_t count) const;

 private:
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

}  // namespace ardrone_vslam
