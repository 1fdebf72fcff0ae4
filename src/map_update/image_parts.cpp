// SPDX-License-Identifier: BSD-3-Clause
#include "map_update/image_parts.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

#include "linear/scalars.hpp"

namespace ardrone_vslam {

std::size_t partOf(const Eigen::Vector2f& ideal_px, const FrameView& view) {
  constexpr int kColumns = 4;
  constexpr int kRows = 3;
  static_assert(kColumns * kRows == kImageParts);
  const Eigen::Array2f size_px = (view.upper_px() - view.lower_px()).array().max(1.0F);
  const Eigen::Array2f share = (ideal_px - view.lower_px()).array() / size_px;
  const int column = std::clamp(static_cast<int>(share.x() * kColumns), 0, kColumns - 1);
  const int row = std::clamp(static_cast<int>(share.y() * kRows), 0, kRows - 1);
  return static_cast<std::size_t>(kColumns * row + column);
}

std::size_t partWith(const Eigen::Vector3d& position_map, const FrameView& view) {
  Eigen::Vector2f px;
  const Eigen::Vector3d direction_map = (position_map - view.origin_map()).normalized();
  return view.idealPixel(direction_map, 0, px) ? partOf(px, view) : kImageParts;
}

ImageParts knownParts(const FrameView& view, const std::vector<Association>& matches,
                      double fix_min_age_s, const LandmarkMap& map) {
  constexpr int kFewest = 4;
  constexpr double kShare = 0.2;  // of its features; with fewer a place is seldom found again
  std::array<int, kImageParts> features{};
  std::array<int, kImageParts> found{};
  for (const Eigen::Vector2f& px : view.idealPixels()) ++features[partOf(px, view)];
  for (const Association& match : matches) {
    const Landmark& landmark = map.all()[static_cast<std::size_t>(match.target)];
    const double age_s = seconds(view.features().stamp_ns - landmark.first_seen_ns);
    const auto feature = static_cast<std::size_t>(match.feature);
    if (age_s >= fix_min_age_s) ++found[partOf(view.idealPixels()[feature], view)];
  }
  ImageParts known;
  for (std::size_t i = 0; i < known.size(); ++i)
    known[i] = found[i] >= kFewest && found[i] >= kShare * features[i];
  return known;
}

bool isSeenIn(const ImageParts& parts, const FrameView& view, const Eigen::Vector3d& position_map) {
  const std::size_t part = partWith(position_map, view);
  return part < parts.size() && parts[part];
}

}  // namespace ardrone_vslam
