// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "ardrone_vslam/saved_map.hpp"

namespace ardrone_vslam {

/// What is in a map: counts, camera, size, how well it is known.
nlohmann::ordered_json factsOf(const SavedMap& map);

/// A line for each landmark: id, position, sigma, times seen, anchor, when it was seen.
std::string csvOf(const SavedMap& map);

/// A cloud of points for MeshLab, CloudCompare and others: position, sigma and times seen.
std::string plyOf(const SavedMap& map);

}  // namespace ardrone_vslam
