// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "ardrone_vslam/slam_config.hpp"
#include "ardrone_vslam/tracker.hpp"
#include "configs/onboard_config.hpp"

namespace ardrone_vslam {

/// All that vslam_onboard is told.
struct Settings {
  OnboardConfig onboard;
  TrackerConfig tracker;
  SlamConfig mapper;
  double odometry_wait_s = 0;  ///< mapper/odometry_wait_s
  std::string map_file;        ///< mapper/map_file
  std::string save_map;        ///< mapper/save_map
  double autosave_s = 0;       ///< AutosaveConfig::period_s()
};

/// Reads a configuration file (an empty path: the defaults), then each "section/key=value" of
/// `overrides`. Keys that only the nodelets use are passed over.
/// @throws ConfigError listing every fault
Settings loadSettings(const std::string& path, const std::vector<std::string>& overrides);

/// T_base_cam of camera_position_m and camera_rotation_deg. @throws ConfigError
Eigen::Isometry3d extrinsicsOf(const OnboardConfig& config);

/// What is taken from the system at the start: working_mb, and for each landmark kLandmark_bytes.
std::size_t memory_bytes(const Settings& settings);

}  // namespace ardrone_vslam
