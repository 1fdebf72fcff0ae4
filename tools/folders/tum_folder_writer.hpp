// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "sequences/sequence.hpp"

namespace ardrone_vslam {

struct TumFolderOptions {
  /// Lines for the head of odometry_tum.txt: what drifts, and how to make it again.
  std::string odometry_comment;
  std::function<void(std::size_t done, std::size_t total)> progress;  ///< images; may be empty
};

/// Writes a TUM-like folder: image/NNNNNN.png, times.txt, camera.yaml as camera_calibration writes
/// it, poses_tum.txt (T_world_cam) when the truth is known and odometry_tum.txt (T_odom_base) when
/// the sequence has odometry, range.txt when it has ranges (of its own base). Base of such a
/// folder is the camera's position with the axes of REP-103: poses of another base are carried over
/// to it. The folder appears when it is complete; a failure leaves nothing behind.
/// @throws std::runtime_error naming path, fault and remedy; also when the path exists
void writeTumFolder(Sequence& sequence, const std::string& path,
                    const TumFolderOptions& options = {});

}  // namespace ardrone_vslam
