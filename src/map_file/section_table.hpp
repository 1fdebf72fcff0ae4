// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "map_file/map_file_input.hpp"
#include "map_file/map_sections.hpp"

namespace ardrone_vslam {

/// Where a section's bytes are.
struct MapSection {
  SectionTag tag{};
  std::uint64_t offset = 0;
  std::size_t size = 0;
};

/// The sections of a file.
class SectionTable {
 public:
  /// Goes through the whole file, with little memory.
  /// @throws MapFileError when it is no map file or one of a newer version, when bytes are missing,
  /// changed or too many, when a section is there twice, or when this version would have to know it
  explicit SectionTable(const MapFileInput& file);

  /// nullptr when it is not there
  const MapSection* search(const SectionTag& tag) const;
  /// @throws MapFileError when it is not there
  const MapSection& find(const SectionTag& tag) const;

 private:
  void add(const MapSection& section);

  std::vector<MapSection> sections_;
};

}  // namespace ardrone_vslam
