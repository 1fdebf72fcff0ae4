// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "ardrone_vslam/features.hpp"
#include "matching/track_order.hpp"
#include "window/track_window.hpp"
#include "window/window_state.hpp"

namespace ardrone_vslam {

/// Where nothing else tells the drift: the camera has moved by no more than the image shows in a
/// scene so far away, so a hovering drone stays though its odometry drifts. O(frames x tracks).
/// @param order  of the newest frame's features
/// @param tracks  of the window
/// @param view_rig  the camera's optical axis, axes of the rig
/// @param depth_m  not the landmarks' distance: what drift made is as much too far away
void limitByScene(const ImageFeatures& features, const TrackOrder& order, TrackWindow& tracks,
                  const Eigen::Vector3d& view_rig, double depth_m, WindowState& state);

}  // namespace ardrone_vslam
