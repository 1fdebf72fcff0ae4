// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <bitset>
#include <cstddef>
#include <vector>

#include "map/association.hpp"
#include "map/landmark_map.hpp"
#include "matching/frame_view.hpp"

namespace ardrone_vslam {

/// Of so many equal parts, 4 x 3, of all that the camera has shown so far.
constexpr std::size_t kImageParts = 12;
/// The one with an ideal pixel.
std::size_t partOf(const Eigen::Vector2f& ideal_px, const FrameView& view);
/// The one in which a point is seen; kImageParts where it is out of view.
std::size_t partWith(const Eigen::Vector3d& position_map, const FrameView& view);

using ImageParts = std::bitset<kImageParts>;
/// Those in which enough of the features are landmarks of earlier visits. More landmarks would tell
/// nothing new there, and the map of a drone that hovers or circles would grow without end.
ImageParts knownParts(const FrameView& view, const std::vector<Association>& matches,
                      double fix_min_age_s, const LandmarkMap& map);
/// Whether a point is seen in one of them.
bool isSeenIn(const ImageParts& parts, const FrameView& view, const Eigen::Vector3d& position_map);

}  // namespace ardrone_vslam
