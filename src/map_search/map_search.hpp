// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <utility>

#include "ardrone_vslam/features.hpp"
#include "ardrone_vslam/saved_map.hpp"
#include "ardrone_vslam/slam_config.hpp"
#include "estimator/frame_budget.hpp"
#include "map/landmark_map.hpp"
#include "map_search/place_look.hpp"
#include "map_search/place_sights.hpp"
#include "window/map_entry.hpp"

namespace ardrone_vslam {

/// Looks for a flight in the map of an earlier one, by images and gravity alone: position and
/// heading are unknown. Features are matched with all landmarks; the pose that more of them agree
/// on than chance explains is an observation of the place; the flight is found once several
/// observations, by images apart in time, agree on where it began and show what is in the map.
class MapSearch {
 public:
  /// @param is_own  it is the map of this very flight
  MapSearch(SavedMap map, const SlamConfig& config, bool is_own = false);

  /// An image of a flight that has not been found yet. O(features x landmarks), by an index from
  /// `index_from_landmarks` on.
  /// @param T_flight_cam  the camera in the flight's own map: roll and pitch count, and what lies
  /// between two images
  /// @return where the flight is, once
  std::optional<MapEntry> see(const ImageFeatures& features, const Eigen::Isometry3d& T_flight_cam,
                              const Eigen::Isometry3d& T_base_cam, FrameBudget& budget);
  /// From now on only places near the hint count, of where base is at the next image, and only
  /// landmarks that may be seen from there. O(landmarks).
  void lookNear(const PlaceHint& hint);

  /// The map that is searched.
  const SavedMap& map() const { return map_; }
  /// The same, which then is not searched any more.
  SavedMap takeMap() { return std::move(map_); }
  bool isOwn() const { return is_own_; }

 private:
  /// What was said, and where the flight had base then.
  struct Near {
    PlaceHint hint;
    std::optional<Eigen::Isometry3d> T_flight_base;

    bool mayShow(const Landmark& landmark) const;
    bool allows(const MapEntry& entry) const;
  };

  void gatherLandmarks();

  SavedMap map_;
  bool is_own_;
  PlaceLook look_;
  LandmarkMap landmarks_;  // that are looked for
  std::optional<Near> near_;
  std::int64_t looked_ns_ = 0;
  PlaceSights sights_;
};

}  // namespace ardrone_vslam
