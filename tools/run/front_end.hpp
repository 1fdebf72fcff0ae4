// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "ardrone_vslam/features.hpp"
#include "ardrone_vslam/tracker_config.hpp"
#include "sequences/sequence.hpp"
#include "stamps/stage_timer.hpp"

namespace ardrone_vslam {

/// One image after the front end.
struct TrackedFrame {
  ImageFeatures features;
  StageTimes_ms times_ms{};
  /// T_base_cam of another camera than the frame's before.
  std::optional<Eigen::Isometry3d> other_camera;
};

/// With `use_attitude`: poses whose orientation turns the descriptors' pattern, for images exposed
/// at their stamps plus the offset.
struct FrontEndAttitude {
  const std::vector<OdometryState>* states = nullptr;
  NumberOrAuto image_time_offset_s;
};

/// The image after one that is done; a sequence's size ends the run.
using NextImage = std::function<std::size_t(std::size_t index)>;

/// Images -> features; images are decoded ahead by a thread of their own when `threads` is 2 or
/// more.
/// @param consume  gets each frame in order; `frame` is reused for the next one
/// @param next_image  asked after each; nothing: all images
void runFrontEnd(Sequence& sequence, const TrackerConfig& config, const FrontEndAttitude& attitude,
                 int threads, const std::function<void(const TrackedFrame& frame)>& consume,
                 const NextImage& next_image = {});

}  // namespace ardrone_vslam
