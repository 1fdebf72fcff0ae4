// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "ardrone_vslam/slam_config.hpp"
#include "association/target_search.hpp"
#include "map/association.hpp"
#include "map/feature_map.hpp"
#include "matching/frame_view.hpp"

namespace ardrone_vslam {

/// Finds the features without depth that a frame shows again, and removes mismatches (thesis 5.3).
class MapFeatureAssociator {
 public:
  /// @throws ConfigError listing every parameter out of its range
  explicit MapFeatureAssociator(const AssociationConfig& config);

  /// Map features seen again by those of the frame's features that `taken` does not mark: by track,
  /// else by descriptor around where rotation alone would put them; matches off the epipolar plane
  /// are mismatches (5.37-5.44).
  void match(const FrameView& view, const FeatureMap& map, const std::vector<bool>& taken,
             AssociationResult& result);

 private:
  void decide(const FrameView& view, const FeatureMap& map, const Association& candidate,
              AssociationResult& result);
  void search(const FrameView& view, const FeatureMap& map, AssociationResult& result);
  bool isEpipolarMismatch(const FrameView& view, const MapFeature& first, int feature) const;

  AssociationConfig config_;
  TargetSearch search_;        // its targets: the map's features
  std::vector<int> searched_;  // targets
};

}  // namespace ardrone_vslam
