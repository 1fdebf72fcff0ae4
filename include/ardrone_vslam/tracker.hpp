// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>

#include "ardrone_vslam/camera_model.hpp"
#include "ardrone_vslam/features.hpp"
#include "ardrone_vslam/image_view.hpp"
#include "ardrone_vslam/stages.hpp"
#include "ardrone_vslam/tracker_config.hpp"

namespace ardrone_vslam {

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
  /// @param image_roll_rad  with `use_attitude`: imageRoll_rad() of the camera's attitude; nothing
  ///   where it is not known: then, as without `use_attitude`, each corner's own orientation
  void process(const ImageView& image, std::int64_t stamp_ns, ImageFeatures& features,
               const StageHook& hook = {}, std::optional<float> image_roll_rad = std::nullopt);

  /// Made of the intrinsics; bearings are its.
  const CameraModel& camera() const;
  /// For the tracker that follows this one: FrameTracker::nextTrackId().
  std::uint32_t nextTrackId() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ardrone_vslam
