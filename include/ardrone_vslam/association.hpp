// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "ardrone_vslam/descriptor_matcher.hpp"
#include "ardrone_vslam/feature_map.hpp"
#include "ardrone_vslam/frame_view.hpp"
#include "ardrone_vslam/global_matcher.hpp"
#include "ardrone_vslam/landmark_map.hpp"
#include "ardrone_vslam/parameters.hpp"
#include "ardrone_vslam/track_order.hpp"
#include "ardrone_vslam/window_search.hpp"

namespace ardrone_vslam {

/// How landmarks and map features are looked for, and what is a mismatch.
struct AssociationConfig {
  double search_radius_px = 30.0;
  double landmark_threshold_px = 8.0;
  double epipolar_threshold_px = 2.0;
  double threshold_deviations = 3.0;
  double widening_s = 10.0;
  double max_view_angle_deg = 60.0;
  double max_distance_ratio = 10.0;
  double max_window_share = 0.5;
  int index_from_landmarks = 10000;
  int index_probes = 32;
  MatcherConfig matcher;
};

template <class Visitor>
void visitParameters(AssociationConfig& c, Visitor&& visit) {
  visit(ParameterInfo{"search_radius_px", "px", 1, 2000,
                      "window around the predicted pixel in which descriptors are compared"},
        c.search_radius_px);
  visit(ParameterInfo{"landmark_threshold_px", "px", 0.1, 2000,
                      "a landmark match further from its prediction is a mismatch (5.36)"},
        c.landmark_threshold_px);
  visit(ParameterInfo{"epipolar_threshold_px", "px", 0.1, 2000,
                      "a feature match further from its epipolar line is a mismatch (5.44)"},
        c.epipolar_threshold_px);
  visit(ParameterInfo{"threshold_deviations", "-", 0, 20,
                      "adds this many deviations of the pose, seen at the landmark's distance, to "
                      "window and threshold; 0: fixed"},
        c.threshold_deviations);
  visit(ParameterInfo{"widening_s", "s", 0.01, 1e6,
                      "constraint filter: those deviations are taken for twice as large after so "
                      "many seconds in which nothing was recognised, three times after twice as "
                      "many, and so on"},
        c.widening_s);
  visit(ParameterInfo{"max_view_angle_deg", "deg", 1, 180,
                      "landmarks last seen from a direction further off are not searched"},
        c.max_view_angle_deg);
  visit(ParameterInfo{"max_distance_ratio", "-", 1, 1e6,
                      "landmarks are not searched from so many times nearer or further away than "
                      "they were last seen"},
        c.max_distance_ratio);
  visit(ParameterInfo{"max_window_share", "-", 0, 1e6,
                      "when the windows' radius (median) exceeds this share of the image width, "
                      "features are compared with all landmarks, wherever they should be"},
        c.max_window_share);
  visit(ParameterInfo{"index_from_landmarks", "landmarks", 0, 10000000,
                      "maps of so many are then searched by an index, smaller ones exactly"},
        c.index_from_landmarks);
  visit(ParameterInfo{"index_probes", "lists", 1, 1000000,
                      "lists of the index compared with each feature: more find more, slower"},
        c.index_probes);
  visitParameters(c.matcher, visit);
}

/// `target` is the index of a landmark or map feature, `feature` of the frame's feature.
struct Association {
  int target = 0;   ///< index into LandmarkMap::all() or FeatureMap::all()
  int feature = 0;  ///< index into ImageFeatures
};

/// What one search found, before and after the removal of mismatches.
struct AssociationResult {
  std::vector<Association> matches;           ///< what is left after the removal of mismatches
  MatchMethod method = MatchMethod::kGuided;  ///< how it was looked for
  int in_view = 0;                            ///< targets that the prediction puts into the image
  int candidates = 0;                         ///< descriptor or track matches
  int mismatches = 0;                         ///< removed of them
  std::vector<int> missed;  ///< targets in view without a match; none unless guided
};

/// Finds the landmarks and map features that a frame shows, and removes mismatches (thesis 5.3).
class Associator {
 public:
  /// @throws ConfigError listing every parameter out of its range
  explicit Associator(const AssociationConfig& config);

  /// Landmarks seen by the frame. Each landmark and each feature at most once.
  /// - The prior is narrow: those that the predicted pose puts into the image and that were last
  ///   seen from a like direction and distance, by track or by the best descriptor within a window
  ///   that grows with the prior's deviation.
  /// - The windows would hold most of the image (max_window_share): by track, or by the best
  ///   descriptor among all landmarks, found exactly or by the map's index.
  /// A match whose ray is off the prediction by more than the threshold is a mismatch (5.36).
  /// O(landmarks + pairs inside windows), or as matchExact or DescriptorIndex::search.
  void matchLandmarks(const FrameView& view, LandmarkMap& map, AssociationResult& result);

  /// A match is a mismatch when it is off the prediction by more than this.
  double threshold_rad(const FrameView& view, const Landmark& landmark, double distance_m) const;

  /// Map features seen again by those of the frame's features that `taken` does not mark: by track,
  /// else by descriptor around where rotation alone would put them; matches off the epipolar plane
  /// are mismatches (5.37-5.44).
  void matchMapFeatures(const FrameView& view, const FeatureMap& map,
                        const std::vector<bool>& taken, AssociationResult& result);

 private:
  void begin(const FrameView& view, std::size_t target_count);
  int featureOfTrack(std::uint32_t track_id) const;
  int bestFeature(int target) const;
  double margin_px(const FrameView& view, std::uint32_t anchor_id, double position_variance_m2,
                   double distance_m) const;
  bool windowsAreWide(const FrameView& view, const LandmarkColumns& columns);
  MatchMethod chooseMethod(const FrameView& view, LandmarkMap& map, const LandmarkColumns& columns);
  void matchGuided(const FrameView& view, const LandmarkMap& map, const LandmarkColumns& columns,
                   AssociationResult& result);
  void matchGlobally(const FrameView& view, LandmarkMap& map, const LandmarkColumns& columns,
                     AssociationResult& result);
  bool decideLandmark(const FrameView& view, const LandmarkMap& map, const Association& candidate,
                      AssociationResult& result);
  bool isLandmarkMismatch(const FrameView& view, const Landmark& landmark, int feature) const;
  bool isEpipolarMismatch(const FrameView& view, const MapFeature& first, int feature) const;

  AssociationConfig config_;
  GlobalMatcher global_matcher_;
  VisibleLandmarks visible_;
  std::vector<float> radius_px_;  // window of each visible landmark
  std::vector<float> sorted_radii_px_;
  // Targets are numbered as they are visited: visible landmarks, or the map's features.
  WindowSearch windows_;  // of the features not taken by tracks
  std::vector<BestTwo> best_of_target_;
  std::vector<bool> feature_taken_;
  std::vector<bool> landmark_taken_;
  std::vector<int> targets_in_view_;
  TrackOrder tracks_;  // of the frame's features
};

}  // namespace ardrone_vslam
