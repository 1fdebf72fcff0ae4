// SPDX-License-Identifier: BSD-3-Clause
#include "program/map_options.hpp"

#include <CLI/CLI.hpp>
#include <iostream>

namespace ardrone_vslam {

void MapOptions::addTo(CLI::App& app) {
  app.add_option("--map", loaded,
                 "the flight takes place in this map of an earlier one, in which it is looked for; "
                 "errors are against a truth in that map's frame")
      ->check(CLI::ExistingFile);
  app.add_option("--save-map", saved, "write the map there at the end")->excludes("--seeds");
  app.add_flag("--localise-only", localise_only, "leave the loaded map as it is")->needs("--map");
  app.add_flag("--refine", is_refined,
               "then optimise the whole flight at once: refined.tum beside fused.tum, and "
               "--save-map writes the refined map")
      ->excludes("--map");
}

std::vector<std::string> MapOptions::save(const SavedMap& map, const char* made_by) const {
  if (map.landmarks.empty())
    return {"the flight has no landmark, so no map is written to " + saved};
  try {
    const std::size_t landmarks = writeMap(saved, map, made_by);
    std::cout << "map of " << landmarks << " landmarks written to " << saved << '\n';
    return {};
  } catch (const MapFileError& e) {
    return {e.what()};
  }
}

}  // namespace ardrone_vslam
