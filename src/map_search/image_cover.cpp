// SPDX-License-Identifier: BSD-3-Clause
#include "map_search/image_cover.hpp"

#include <algorithm>
#include <array>

#include "map_update/image_parts.hpp"

namespace ardrone_vslam {
namespace {

constexpr int kFewestInCell = 4;
// From another side, in other light, most landmarks of the right place are not found, either.
constexpr double kRecognised = 0.1;

}  // namespace

double ImageCover::of(const FrameView& view, LandmarkMap& map) {
  std::array<int, kImageParts> visible{};
  std::array<int, kImageParts> found{};
  associator_.matchLandmarks(view, map, matches_);
  const auto countIn = [&](std::array<int, kImageParts>& cells, int landmark) {
    const Eigen::Vector3d& point = map.all()[static_cast<std::size_t>(landmark)].position_map;
    const std::size_t part = partWith(point, view);
    if (part < cells.size()) ++cells[part];
  };
  for (const Association& match : matches_.matches) {
    countIn(visible, match.target);
    countIn(found, match.target);
  }
  for (const int landmark : matches_.missed) countIn(visible, landmark);
  int shown = 0;
  int recognised = 0;
  for (std::size_t i = 0; i < visible.size(); ++i) {
    if (visible[i] < kFewestInCell) continue;
    ++shown;
    if (found[i] >= kRecognised * visible[i]) ++recognised;
  }
  return shown == 0 ? 0 : static_cast<double>(recognised) / shown;
}

}  // namespace ardrone_vslam
