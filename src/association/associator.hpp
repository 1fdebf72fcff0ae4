// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "ardrone_vslam/slam_config.hpp"
#include "association/global_matcher.hpp"
#include "association/target_search.hpp"
#include "map/association.hpp"
#include "map/landmark_map.hpp"
#include "matching/frame_view.hpp"

namespace ardrone_vslam {

/// A landmark's match is a mismatch when it is off the prediction by more than this.
double mismatchThreshold_rad(const AssociationConfig& config, const FrameView& view,
                             const Landmark& landmark, double distance_m);

/// Finds the landmarks that a frame shows, and removes mismatches (thesis 5.3).
class Associator {
 public:
  /// @throws ConfigError listing every parameter out of its range
  explicit Associator(const AssociationConfig& config);

  /// Landmarks seen by the frame. Each landmark and each feature at most once.
  /// - The prior is narrow: those that the predicted pose puts into the image and that were last
  ///   seen from a like direction and distance, by track or by the best descriptor within a window
  ///   that grows with the prior's sigma.
  /// - The windows would hold most of the image (max_window_share): by track, or by the best
  ///   descriptor among all landmarks, found exactly or by the map's index.
  /// A match whose ray is off the prediction by more than the threshold is a mismatch (5.36).
  /// O(landmarks + pairs inside windows), or as matchExact or DescriptorIndex::search.
  void matchLandmarks(const FrameView& view, LandmarkMap& map, AssociationResult& result);

 private:
  bool windowsAreWide(const FrameView& view, const LandmarkColumns& columns);
  MatchMethod chooseMethod(const FrameView& view, LandmarkMap& map, const LandmarkColumns& columns);
  void matchGuided(const FrameView& view, const LandmarkMap& map, const LandmarkColumns& columns,
                   AssociationResult& result);
  void matchGlobally(const FrameView& view, LandmarkMap& map, const LandmarkColumns& columns,
                     AssociationResult& result);
  bool decideLandmark(const FrameView& view, const LandmarkMap& map, const Association& candidate,
                      AssociationResult& result);
  bool isLandmarkMismatch(const FrameView& view, const Landmark& landmark, int feature) const;

  AssociationConfig config_;
  GlobalMatcher global_matcher_;
  VisibleLandmarks visible_;
  std::vector<float> radius_px_;  // window of each visible landmark
  std::vector<float> sorted_radii_px_;
  TargetSearch search_;               // its targets: visible_
  std::vector<int> targets_in_view_;  // that no track leads to
  std::vector<bool> landmark_taken_;
};

}  // namespace ardrone_vslam
