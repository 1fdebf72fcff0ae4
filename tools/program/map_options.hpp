// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "ardrone_vslam/saved_map.hpp"

namespace CLI {  // NOLINT(readability-identifier-naming): the library is called so
class App;
}  // namespace CLI

namespace ardrone_vslam {

/// --map, --save-map, --localise-only and --refine.
struct MapOptions {
  std::string loaded;  ///< file of an earlier flight's map; empty: none
  std::string saved;   ///< where the map goes; empty: nowhere
  bool localise_only = false;
  bool is_refined = false;  ///< afterwards, path and map

  /// @pre the program has an option --seeds: a map is of one flight
  void addTo(CLI::App& app);
  /// Writes the map to `saved`, and says so on stdout. @param made_by  program and version
  /// @return why there is none; empty when there is
  std::vector<std::string> save(const SavedMap& map, const char* made_by) const;
};

}  // namespace ardrone_vslam
