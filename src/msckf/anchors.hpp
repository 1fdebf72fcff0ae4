// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <unordered_set>
#include <utility>
#include <vector>

#include "ardrone_vslam/msckf_config.hpp"
#include "matching/frame_view.hpp"
#include "msckf/re_anchoring.hpp"
#include "window/window_state.hpp"

namespace ardrone_vslam {

/// The frames whose errors landmarks share: chosen among the window's, kept as anchors when they
/// leave it, joined when there are too many.
class Anchors {
 public:
  /// @param config  is taken as valid: the filter that holds it has checked it
  explicit Anchors(const MsckfConfig& config) : config_(config) {}

  /// The frame that new points belong to: another one once the camera has gone on from it.
  /// @param point_distance_m  of what is seen from the newest frame; 0: not known
  void choose(const WindowState& state, double point_distance_m);
  /// Hardly a track leads to the newest frame: what is seen from now on does not share the error of
  /// what was seen before, as the drone may be elsewhere. Of another camera's first frame it says
  /// nothing.
  void breakOff() {
    if (!std::exchange(is_another_camera_, false)) current_id_ = 0;
  }
  /// The next frame is another camera's.
  void changeCamera() { is_another_camera_ = true; }
  /// Clone::id of that frame.
  std::uint32_t current() const { return current_id_; }
  /// Points do belong to it.
  void use() { in_use_.insert(current_id_); }
  /// Landmarks of a loaded map belong to these.
  void useLoaded(const std::vector<Clone>& loaded) {
    for (const Clone& anchor : loaded) re_anchoring_.begin(anchor);
  }
  /// A frame leaves the window: as an anchor when points belong to it.
  /// @param frame  index into state.frames()
  void retire(std::size_t frame, WindowState& state);

  /// How the landmarks are to be moved, as their anchors have been corrected.
  std::vector<AnchorCorrection> takeCorrections(const WindowState& state, double point_distance_m,
                                                double focal_length_px);

 private:
  void joinNearest(WindowState& state);

  MsckfConfig config_;
  std::uint32_t current_id_ = 0;                     // 0: none yet, or none since a break
  std::unordered_set<std::uint32_t> after_a_break_;  // the first ones after one
  std::unordered_set<std::uint32_t> in_use_;         // frames of the window that points belong to
  bool is_another_camera_ = false;
  ReAnchoring re_anchoring_;
};

/// How well the newest pose is known relative to each anchor and frame, ascending in its id.
std::vector<AnchorDrift> driftsOf(const WindowState& state);

}  // namespace ardrone_vslam
