// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "ardrone_vslam/features.hpp"
#include "ardrone_vslam/slam_config.hpp"
#include "association/global_matcher.hpp"
#include "map/landmark_map.hpp"
#include "map_search/image_cover.hpp"
#include "map_search/place_sights.hpp"
#include "map_update/map_fix.hpp"

namespace ardrone_vslam {

/// What is compared in a look.
struct LookLimits {
  /// Only landmarks not seen since then.
  std::int64_t unseen_since_ns = std::numeric_limits<std::int64_t>::max();
  /// So many features of the image, from all parts of it.
  std::size_t most_features = std::numeric_limits<std::size_t>::max();
};

/// One image's look at a map, by descriptors and gravity alone: its features are matched with all
/// landmarks; the pose that more of them agree on than chance explains is a sight of a place.
class PlaceLook {
 public:
  explicit PlaceLook(const SlamConfig& config);

  /// O(features x landmarks), by an index from `index_from_landmarks` on, which takes several looks
  /// to be laid out.
  /// @param T_flight_cam  where the camera is thought to be: roll and pitch count
  std::optional<PlaceSight> at(const ImageFeatures& features, const Eigen::Isometry3d& T_flight_cam,
                               LandmarkMap& map, const LookLimits& limits = LookLimits());

 private:
  std::vector<MapObservation> observe(const ImageFeatures& features, LandmarkMap& map,
                                      const LookLimits& limits);
  double cover(const ImageFeatures& features, const ObservationConsensus& consensus,
               double distance_m, LandmarkMap& map);

  double angle_sigma_px_;
  double tilt_sigma_rad_;
  std::size_t index_from_landmarks_;
  GlobalMatcher matcher_;
  ImageCover cover_;
};

}  // namespace ardrone_vslam
