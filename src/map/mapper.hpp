// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "ardrone_vslam/slam_config.hpp"
#include "map/association.hpp"
#include "map/feature_map.hpp"
#include "map/landmark_map.hpp"
#include "matching/frame_view.hpp"

namespace ardrone_vslam {

/// Makes, refines and removes landmarks (thesis 5.2, 5.4, algorithm 5) from a pose that
/// is known.
class Mapper {
 public:
  explicit Mapper(const MapperConfig& config) : config_(config) {}

  /// sigma_a for a camera of this focal length.
  double angleSigma_rad(double focal_length_px) const {
    return config_.angle_sigma_px / focal_length_px;
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
  /// Of a landmark or of its measurement, across the ray. @param variance_then_m2  see FrameView
  double sigmaOf_m(const FrameView& view, double variance_then_m2, double depth_m) const;
  /// Depth comes from parallax, which grows while a track goes on; the scalar update across the ray
  /// hardly mends it.
  void widenBaseline(const FrameView& view, std::size_t feature, const Ray& first_ray,
                     Landmark& landmark) const;

  MapperConfig config_;
};

}  // namespace ardrone_vslam
