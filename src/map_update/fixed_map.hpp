// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "ardrone_vslam/saved_map.hpp"
#include "estimator/estimator.hpp"

namespace ardrone_vslam {

/// A loaded map that a flight leaves as it is (`localise_only`). The filter takes it for exact, so
/// that the pose is where the map's landmarks say, again and again the same. Beside errors of the
/// map that could be corrected, the filter would take what landmarks and odometry disagree by for
/// the map's, each time anew, and drift off from it. How the map errs is added to what is told.
class FixedMap {
 public:
  /// Keeps what is said of its anchors, and makes it exact: all landmarks belong to one anchor,
  /// which has no error. O(landmarks).
  /// @param map  is made exact. @pre it has anchors (asserted)
  /// @param entry  its anchor becomes that one
  FixedMap(SavedMap& map, MapEntry& entry);

  /// As it was loaded, but for anchors without landmarks. @param landmarks  all of them, as the
  /// flight has them, in their order
  MapSnapshot snapshotWith(const Landmarks& landmarks, std::int64_t stamp_ns) const;

  /// The pose errs as the map does there, which is as its nearest anchor does, beside what it errs
  /// in the map. The scale is at best that of the map. O(anchors).
  void addErrors(Estimate& estimate) const;

 private:
  SavedMap map_;                                               // without landmarks
  std::shared_ptr<const std::vector<std::uint32_t>> anchors_;  // Landmark::anchor_id of each
};

}  // namespace ardrone_vslam
