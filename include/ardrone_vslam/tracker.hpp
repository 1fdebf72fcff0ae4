// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>

#include "ardrone_vslam/camera_model.hpp"
#include "ardrone_vslam/corner_detector.hpp"
#include "ardrone_vslam/features.hpp"
#include "ardrone_vslam/frame_tracker.hpp"
#include "ardrone_vslam/freak.hpp"
#include "ardrone_vslam/stages.hpp"

namespace ardrone_vslam {

/// All that makes features of an image.
struct TrackerConfig {
  CornerDetectorConfig corners;
  FreakConfig freak;
  FrameTrackerConfig tracks;
  UndistortMethod undistort = UndistortMethod::kTable;
  bool use_attitude = false;
};

template <>
struct EnumNames<UndistortMethod> {
  static constexpr std::array<const char*, 3> kNames{"table", "exact", "closed_form"};
};

template <class Visitor>
void visitParameters(TrackerConfig& c, Visitor&& visit) {
  visitParameters(c.corners, visit);
  visitParameters(c.freak, visit);
  visitParameters(c.tracks, visit);
  visit(ParameterInfo{"undistort", "choice", 0, 0,
                      "table: the exact inverse by table, within 1e-6 px; exact: by Newton; "
                      "closed_form: Drap & Lefevre's three terms, pixels off for strong lenses"},
        c.undistort);
  visit(ParameterInfo{"use_attitude", "switch", 0, 0,
                      "turn FREAK's pattern by the observer's attitude (nodelet: topic `attitude`) "
                      "instead of 45 pairs a corner: cheaper and steadier; without attitude the 45 "
                      "pairs"},
        c.use_attitude);
}

/// Image -> ImageFeatures: corners, descriptors, bearings, track ids (thesis algorithm 1). One
/// instance per camera.
class Tracker {
 public:
  /// @throws ConfigError listing every invalid parameter; std::invalid_argument for an impossible
  /// camera.
  /// @param first_track_id  see FrameTracker
  Tracker(const TrackerConfig& config, const CameraIntrinsics& camera,
          std::uint32_t first_track_id = 1);
  ~Tracker();

  /// Allocates in the first call only, and if `features` has no room for the corner budget.
  /// @param image  as large as the camera's calibration says (asserted)
  /// @param features  cleared and filled; corners whose descriptor or bearing does not exist are
  /// left out
  /// @param hook  told which stage begins; may be empty
  /// @param scene_turn_rad  with `use_attitude`: sceneTurn_rad() of the camera's attitude; nothing
  ///   where it is not known: then, as without `use_attitude`, each corner's own orientation
  void process(const ImageView& image, std::int64_t stamp_ns, ImageFeatures& features,
               const StageHook& hook = {}, std::optional<float> scene_turn_rad = std::nullopt);

  /// Made of the intrinsics; bearings are its.
  const CameraModel& camera() const;
  /// For the tracker that follows this one: FrameTracker::nextTrackId().
  std::uint32_t nextTrackId() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ardrone_vslam
