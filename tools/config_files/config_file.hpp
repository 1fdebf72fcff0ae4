// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ardrone_vslam/slam_config.hpp"
#include "ardrone_vslam/tracker.hpp"

namespace ardrone_vslam {

/// What config/*.yaml holds: sections `tracker` and `mapper`, the same files that roslaunch loads
/// for the nodelets. The sections `odometry_fusion` and
/// `onboard` are checked and not used.
struct PipelineConfig {
  TrackerConfig tracker;
  SlamConfig mapper;
  bool rectified =
      false;  ///< tracker/rectified: a bag's images are rectified, its camera_info's P holds
  bool rescale_calibration = false;  ///< tracker/rescale_calibration, of a bag
  std::string base_frame;  ///< mapper/base_frame, of a bag; empty: the odometry's child_frame_id
};

/// Reads the file (an empty path: the defaults), then applies each "key=value" or
/// "section/key=value" of `overrides`.
/// @throws ConfigError listing every fault: unreadable file, unknown key (with the nearest known
/// ones of both sections), wrong type, range
PipelineConfig loadConfig(const std::string& path, const std::vector<std::string>& overrides);

/// A parameter of `tracker` or `mapper`, as the file writes it; nothing: it is not there.
/// @throws ConfigError for a file that cannot be read
std::optional<std::string> writtenValue(const std::string& path, const std::string& section,
                                        const std::string& key);
/// As a file would write it.
std::string defaultValue(const std::string& section, const std::string& key);

}  // namespace ardrone_vslam
