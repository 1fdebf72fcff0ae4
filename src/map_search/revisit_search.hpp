// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>

#include "ardrone_vslam/features.hpp"
#include "ardrone_vslam/frame_result.hpp"
#include "ardrone_vslam/slam_config.hpp"
#include "map/landmark_map.hpp"
#include "map_search/place_look.hpp"
#include "map_search/place_sights.hpp"
#include "window/map_entry.hpp"

namespace ardrone_vslam {

/// Finds a flight in its own map where it does not think to be: it was carried there with the
/// camera covered, or its odometry erred by more than any search window allows for. While no
/// landmark of an earlier visit is recognised, it looks at the whole map now and then, and more
/// often once it has seen something. A place counts as one in a loaded map does, see PlaceSights.
class RevisitSearch {
 public:
  explicit RevisitSearch(const SlamConfig& config) : look_(config) {}

  /// An image, before its landmarks are looked for. Costs a PlaceLook once a second at most, five
  /// times a second while one sight follows another.
  /// @param before  what the image before made of the pose
  /// @param T_map_cam  where the camera is thought to be
  /// @return where it is instead, once
  std::optional<Revisit> see(const ImageFeatures& features, SlamState before,
                             const Eigen::Isometry3d& T_map_cam, LandmarkMap& map);

 private:
  void beginAnew(std::int64_t stamp_ns);
  bool wasCovered() const { return fewest_tracks_ < kFewestFeatures; }

  PlaceLook look_;
  PlaceSights sights_;
  std::int64_t located_ns_ = 0;  // the last image with landmarks of an earlier visit
  // Of the images since, the last one with the fewest tracks: there the pose was lost, if it was.
  std::size_t fewest_tracks_ = 0;
  std::int64_t lost_ns_ = 0;
  std::int64_t next_look_ns_ = 0;
};

}  // namespace ardrone_vslam
