// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "matching/frame_view.hpp"
#include "matching/match_acceptance.hpp"
#include "matching/track_order.hpp"
#include "matching/window_search.hpp"

namespace ardrone_vslam {

/// Looks for targets among a frame's features, by track or by descriptor within a window; each
/// feature is taken once. Targets are numbered as they are visited.
class TargetSearch {
 public:
  static constexpr int kNobody = -1;

  explicit TargetSearch(const MatcherConfig& config) : config_(config) {}

  /// A frame of which no feature is taken.
  void begin(const FrameView& view, std::size_t target_count);

  bool isTaken(int feature) const { return taken_[static_cast<std::size_t>(feature)]; }
  void take(int feature) { taken_[static_cast<std::size_t>(feature)] = true; }
  const std::vector<bool>& taken() const { return taken_; }

  /// @return kNobody when the track does not go through the frame
  int featureOfTrack(std::uint32_t track_id) const;

  /// The following searches are among the features that are not taken now.
  void openWindows(const FrameView& view);
  /// @param target  above those searched for since openWindows()
  void search(int target, const DescriptorBits& descriptor, const Eigen::Vector2f& centre_px,
              float radius_px);
  /// Of a target that was searched for, after all searches. @return kNobody: none is a match
  int bestFeature(int target) const;

 private:
  MatcherConfig config_;
  TrackOrder tracks_;  // of the frame's features
  std::vector<bool> taken_;
  WindowSearch windows_;
  std::vector<BestTwo> best_of_target_;
};

}  // namespace ardrone_vslam
