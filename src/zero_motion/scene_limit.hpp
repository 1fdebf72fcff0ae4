// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "ardrone_vslam/features.hpp"
#include "matching/track_order.hpp"
#include "window/track_window.hpp"
#include "window/window_state.hpp"
#include "zero_motion/scene_depth.hpp"

namespace ardrone_vslam {

/// Where nothing else tells the drift: the camera has moved by what the image shows in a scene as
/// far away as is known, so a hovering drone stays though its odometry drifts. What is within a
/// sigma of that is left to the odometry. O(frames x tracks).
/// @param order  of the newest frame's features
/// @param camera_rig  the camera's position in the rig
/// @param tracks  of the window
void limitByScene(const ImageFeatures& features, const TrackOrder& order,
                  const Eigen::Vector3d& camera_rig, const SceneDepth& depth, TrackWindow& tracks,
                  WindowState& state);

}  // namespace ardrone_vslam
