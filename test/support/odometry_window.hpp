// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "window/propagator.hpp"
#include "window/window_state.hpp"

namespace ardrone_vslam {

/// A window with what carries it on.
struct OdometryWindow : WindowState {
  explicit OdometryWindow(const OdometryNoiseConfig& config = {}, std::uint32_t first_frame_id = 1)
      : propagator(config, FrameIds(first_frame_id)) {}

  /// Begins with the first odometry, and adds a frame by each that follows.
  void add(const OdometryState& odometry) {
    if (frames().empty())
      propagator.start(odometry, *this);
    else
      propagator.propagate(odometry, std::nullopt, *this);
  }

  Propagator propagator;
};

}  // namespace ardrone_vslam
