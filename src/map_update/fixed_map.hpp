// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ardrone_vslam/saved_map.hpp"
#include "estimator/estimator.hpp"

namespace ardrone_vslam {

/// A loaded map that a flight leaves as it is (`localise_only`). The filter takes it for exact, so
/// that the pose is where the map's landmarks say, again and again the same. Beside errors of the
/// map that could be corrected, the filter would take what landmarks and odometry disagree by for
/// the map's, each time anew, and drift off from it. How the map errs is added to what is told.
class FixedMap {
 public:
  /// @pre it has anchors (asserted)
  explicit FixedMap(SavedMap map);

  /// As it was loaded.
  const SavedMap& map() const { return map_; }
  /// The same, but for the anchors: all landmarks belong to one, which is exact. O(landmarks).
  /// @param entry  its anchor becomes that one
  SavedMap exact(MapEntry& entry) const;

  /// The pose errs as the map does there, which is as its nearest anchor does. O(anchors).
  void addErrors(Estimate& estimate) const;

 private:
  SavedMap map_;
};

}  // namespace ardrone_vslam
