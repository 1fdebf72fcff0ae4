// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "ardrone_vslam/association.hpp"
#include "ardrone_vslam/feature_map.hpp"
#include "ardrone_vslam/frame_view.hpp"
#include "ardrone_vslam/landmark_map.hpp"
#include "ardrone_vslam/parameters.hpp"

namespace ardrone_vslam {

/// When a feature becomes a landmark, how well it is known then, and when it is dropped.
struct MapperConfig {
  double angle_deviation_px = 1.0;
  double position_deviation_m = 0.01;
  double min_parallax_deg = 1.0;
  double baseline_growth = 1.2;
  double max_depth_m = 1000.0;
  int drop_unconfirmed_after = 5;
  double drop_failing_ratio = 10;
};

template <class Visitor>
void visitParameters(MapperConfig& c, Visitor&& visit) {
  visit(ParameterInfo{"angle_deviation_px", "px", 0.01, 100,
                      "deviation of a measured direction, sigma_a times the focal length"},
        c.angle_deviation_px);
  visit(ParameterInfo{"position_deviation_m", "m", 0, 10,
                      "smallest sigma_p of a new or refined landmark (5.19, 5.22)"},
        c.position_deviation_m);
  visit(ParameterInfo{"min_parallax_deg", "deg", 0.01, 90,
                      "angle between the first and the present view that makes a landmark"},
        c.min_parallax_deg);
  visit(
      ParameterInfo{
          "baseline_growth", "-", 1.0, 1e6,
          "a young landmark is triangulated again when its parallax has grown by this factor"},
      c.baseline_growth);
  visit(ParameterInfo{"max_depth_m", "m", 0.1, 1e5, "points further away do not become landmarks"},
        c.max_depth_m);
  visit(
      ParameterInfo{
          "drop_unconfirmed_after", "frames", 1, 1000000,
          "a landmark seen at most twice is dropped after so many frames in view without a match"},
      c.drop_unconfirmed_after);
  visit(ParameterInfo{"drop_failing_ratio", "-", 0.1, 1e6,
                      "constraint filter: a landmark is dropped after so many failures for every "
                      "time it was seen: not found while others of its place are, or off an "
                      "accepted fix"},
        c.drop_failing_ratio);
}

/// Makes, refines and removes landmarks (thesis 5.2, 5.4, algorithm 5) from a pose that
/// is known.
class Mapper {
 public:
  /// @throws ConfigError listing every parameter out of its range
  explicit Mapper(const MapperConfig& config);

  /// sigma_a for a camera of this focal length.
  double angleDeviation_rad(double focal_length_px) const {
    return config_.angle_deviation_px / focal_length_px;
  }

  /// Scalar Kalman update of each matched landmark (5.20-5.22, 5.30-5.34).
  /// @param view  rays from the FUSED camera position
  void refine(const FrameView& view, const std::vector<Association>& matches,
              LandmarkMap& map) const;

  /// Marks matched landmarks as seen and leaves them where they are.
  static void remember(const FrameView& view, const std::vector<Association>& matches,
                       LandmarkMap& map);

  /// Counts the landmarks that should have been seen; drops those never confirmed. Invalidates
  /// landmark indices.
  /// @return landmarks removed
  int countMissed(const std::vector<int>& missed, LandmarkMap& map) const;

  /// Counts landmarks that were not found though their place is in view, or that contradict an
  /// accepted fix; drops those that fail much more often than they are seen. Invalidates landmark
  /// indices.
  /// @return landmarks removed
  int countFailed(const std::vector<int>& failed, LandmarkMap& map) const;

  /// Matched map features with enough parallax become landmarks and leave the feature map; those
  /// with too little wait.
  /// @param used  set for the frame's features that need not be stored: those that became landmarks
  /// and those whose track waits
  /// @return new landmarks
  int triangulateMatches(const FrameView& view, const std::vector<Association>& matches,
                         FeatureMap& features, LandmarkMap& landmarks,
                         std::vector<bool>& used) const;

  /// Stores the frame's features that `used` does not mark.
  void storeRest(const FrameView& view, const std::vector<bool>& used, FeatureMap& features) const;

 private:
  /// Depth comes from parallax, which grows while a track goes on; the scalar update across the ray
  /// hardly mends it.
  void widenBaseline(const FrameView& view, std::size_t feature, Landmark& landmark) const;

  MapperConfig config_;
};

}  // namespace ardrone_vslam
