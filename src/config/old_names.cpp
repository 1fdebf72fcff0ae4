// SPDX-License-Identifier: BSD-3-Clause
#include <iterator>

#include "ardrone_vslam/parameters.hpp"

namespace ardrone_vslam {
namespace {

using Kind = OldName::Kind;

// Why a parameter became a constant.
constexpr const char* kNoGain = "no recording gained by another value";
constexpr const char* kExperiments = "the thesis's experiments alone vary it";
constexpr const char* kDescriptor = "it is a property of the descriptor, not of a robot";
constexpr const char* kSceneDepth = "the scene's depth is learned";
constexpr const char* kSensor = "the drone's sensors were measured";
constexpr const char* kAsPrinted = "as_printed: true switches it off";
constexpr const char* kRates = "nobody needs another rate or length";
constexpr const char* kSimulation = "make_world has it as an option";

constexpr OldName renamed(const char* section, const char* name, const char* now,
                          const char* why = "") {
  return {Kind::kParameter, section, name, now, why};
}
constexpr OldName constant(const char* section, const char* name, const char* why = kNoGain) {
  return {Kind::kParameter, section, name, "", why};
}

constexpr OldName kTable[] = {
    // Of the tracker.
    constant("tracker", "arc_length_px", kExperiments),
    constant("tracker", "threshold", "it adapts from 35 on"),
    constant("tracker", "threshold_max"),
    constant("tracker", "sampling_passes", kExperiments),
    constant("tracker", "suppression", kExperiments),
    constant("tracker", "adapt_threshold", "without it dark rooms have no corners"),
    constant("tracker", "oriented", "without it nothing is found again after a turn"),
    constant("tracker", "track_max_hamming_bits", kDescriptor),
    constant("tracker", "track_ratio", kDescriptor),
    constant("tracker", "undistort", "the table is exact and the fastest"),
    // Of the mapper, renamed.
    renamed("mapper", "observer_mode", "odometry_mode"),
    renamed("mapper", "observer_height", "odometry_height"),
    renamed("mapper", "observer_buffer_s", "odometry_buffer_s"),
    renamed("mapper", "threshold_deviations", "threshold_sigmas"),
    renamed("mapper", "observer_noise_m_per_sqrt_m", "odometry_noise_m_per_sqrt_m"),
    renamed("mapper", "observer_noise_m_per_sqrt_s", "odometry_noise_m_per_sqrt_s"),
    renamed("mapper", "scale_deviation", "scale_sigma"),
    renamed("mapper", "tilt_deviation_deg", "tilt_sigma_deg"),
    renamed("mapper", "mounting_deviation_deg", "extrinsics_sigma_deg"),
    renamed("mapper", "track_deviation_px", "track_sigma_px"),
    renamed("mapper", "window_frames", "max_clones"),
    renamed("mapper", "height_deviation_m", "height_sigma_m"),
    // Of the mapper, now constants.
    constant("mapper", "observer_max_gap_s"),
    constant("mapper", "fix_independent_landmarks"),
    constant("mapper", "range_max_gap_s", "a sensor with larger holes is too slow"),
    constant("mapper", "range_max_tilt_deg"),
    constant("mapper", "rest_depth_m", kSceneDepth),
    constant("mapper", "zero_motion_depth_m", kSceneDepth),
    constant("mapper", "search_radius_px"),
    constant("mapper", "widening_s"),
    constant("mapper", "max_view_angle_deg", kDescriptor),
    constant("mapper", "max_distance_ratio", kDescriptor),
    constant("mapper", "max_window_share"),
    constant("mapper", "index_from_landmarks"),
    constant("mapper", "index_probes"),
    constant("mapper", "max_hamming_bits", kDescriptor),
    constant("mapper", "match_ratio", kDescriptor),
    constant("mapper", "match_cross_check", kDescriptor),
    constant("mapper", "start_deviation_m"),
    constant("mapper", "velocity_bias_time_s"),
    constant("mapper", "slow_speed_m_s"),
    constant("mapper", "tilt_time_s"),
    constant("mapper", "attitude_states", "without them the pose is worse and no cheaper"),
    constant("mapper", "keyframe_px"),
    constant("mapper", "keyframe_s"),
    constant("mapper", "min_track_views", "three are the fewest that tell a wrong track"),
    constant("mapper", "track_parallax_deviations"),
    constant("mapper", "baseline_uncertainty"),
    constant("mapper", "landmark_deviation"),
    constant("mapper", "anchor_spacing"),
    constant("mapper", "anchor_turn_deg"),
    constant("mapper", "min_fix_landmarks"),
    constant("mapper", "fix_drift_share"),
    constant("mapper", "fix_gate_deviations"),
    constant("mapper", "relocation_window_deg"),
    constant("mapper", "relocation_gate_deviations"),
    constant("mapper", "rest_after_s"),
    constant("mapper", "rest_deviation_px"),
    constant("mapper", "rest_turn_deg_per_s"),
    constant("mapper", "watchdog_deviations"),
    constant("mapper", "watchdog_nis"),
    constant("mapper", "watchdog_s"),
    constant("mapper", "watchdog_pause_s"),
    constant("mapper", "height_interval_s", "a sonar's neighbouring heights err alike"),
    constant("mapper", "height_gate_deviations"),
    constant("mapper", "floor_step_s"),
    constant("mapper", "floor_point_deviation_m"),
    constant("mapper", "drop_unconfirmed_after"),
    constant("mapper", "drop_failing_ratio"),
    constant("mapper", "max_map_features"),
    constant("mapper", "max_feature_age_s"),
    constant("mapper", "min_parallax_deg"),
    constant("mapper", "baseline_growth"),
    constant("mapper", "max_depth_m", "it is 200 m for every robot"),
    constant("mapper", "map_publish_hz", kRates),
    constant("mapper", "max_path_poses", kRates),
    // Of the thesis's filter.
    constant("mapper", "mean", kExperiments),
    constant("mapper", "outlier_deviations", kExperiments),
    constant("mapper", "common_drift", kAsPrinted),
    constant("mapper", "fix_deviation_floor_m", kAsPrinted),
    constant("mapper", "fix_angle_floor_deg", kAsPrinted),
    constant("mapper", "gate_deviations", kAsPrinted),
    constant("mapper", "initial_deviation_m"),
    constant("mapper", "attitude_deviation_deg"),
    constant("mapper", "angle_deviation_px"),
    constant("mapper", "position_deviation_m"),
    // Of the package's own observer.
    constant("mapper", "navdata_flow_noise_m_s_per_sqrt_hz", kSensor),
    constant("mapper", "navdata_flow_bias_m_s", kSensor),
    constant("mapper", "navdata_flow_bias_time_s", kSensor),
    constant("mapper", "navdata_flow_scale_deviation", kSensor),
    constant("mapper", "navdata_tilt_deviation_deg", kSensor),
    constant("mapper", "navdata_tilt_time_s", kSensor),
    constant("mapper", "navdata_yaw_walk_deg_per_sqrt_s", kSensor),
    constant("mapper", "navdata_force_noise_m_s2_per_sqrt_hz", kSensor),
    constant("mapper", "navdata_force_bias_m_s2", kSensor),
    constant("mapper", "navdata_drag_per_s", kSensor),
    constant("mapper", "navdata_drag_deviation_per_s", kSensor),
    constant("mapper", "navdata_gust_m_s2_per_sqrt_hz", kSensor),
    constant("mapper", "navdata_height_noise_m", kSensor),
    constant("mapper", "navdata_table_step_m", kSensor),
    constant("mapper", "navdata_command_time_s", kSensor),
    constant("mapper", "navdata_command_tilt_deg",
             "it is the driver's euler_angle_max as it comes, and only fills holes in navdata"),
    // Of odometry_fusion.
    renamed("odometry_fusion", "observer_mode", "odometry_mode"),
    renamed("odometry_fusion", "observer_height", "odometry_height"),
    renamed("odometry_fusion", "observer_buffer_s", "odometry_buffer_s"),
    renamed("odometry_fusion", "scale_deviation", "scale_sigma"),
    renamed("odometry_fusion", "tilt_deviation_deg", "tilt_sigma_deg"),
    constant("odometry_fusion", "observer_max_gap_s"),
    constant("odometry_fusion", "tilt_time_s"),
    // Of the other programs.
    constant("path", "max_poses", kRates),
    constant("path", "publish_hz", kRates),
    renamed("fake_driver", "observer_profile", "odometry_profile"),
    constant("fake_driver", "light", kSimulation),
    constant("fake_driver", "start", kSimulation),
    constant("fake_driver", "wind", kSimulation),
    constant("fake_driver", "world_seed", kSimulation),
    constant("fake_driver", "readout", kSimulation),
    constant("fake_driver", "shutter", kSimulation),
    constant("fake_driver", "gain", kSimulation),
    constant("fake_driver", "image_noise", kSimulation),
    constant("fake_driver", "artefacts", kSimulation),
    constant("fake_driver", "render_threads", kRates),
    renamed("onboard", "camera_x_m", "camera_position_m", "as [x, y, z]"),
    renamed("onboard", "camera_y_m", "camera_position_m", "as [x, y, z]"),
    renamed("onboard", "camera_z_m", "camera_position_m", "as [x, y, z]"),
    renamed("onboard", "camera_roll_deg", "camera_rotation_deg", "as [roll, pitch, yaw]"),
    renamed("onboard", "camera_pitch_deg", "camera_rotation_deg", "as [roll, pitch, yaw]"),
    renamed("onboard", "camera_yaw_deg", "camera_rotation_deg", "as [roll, pitch, yaw]"),
    constant(
        "onboard", "map",
        "save_map of the section mapper gets a map file (map_tool export makes a table of it)"),
    renamed("onboard", "observer_address", "observer", "as ADDRESS:PORT"),
    renamed("onboard", "observer_port", "observer", "as ADDRESS:PORT"),
    renamed("onboard", "pose_port", "pose_address", "as ADDRESS:PORT"),
    renamed("onboard", "telemetry_port", "telemetry_address", "as ADDRESS:PORT"),
    constant("onboard", "controller_silent_s", kRates),
    constant("onboard", "every_frame", "give the option --every-frame"),
    constant("onboard", "poses", "give the option --poses FILE"),
    renamed("onboard_bridge", "port", "address", "as ADDRESS:PORT"),
    constant("onboard_bridge", "silent_s", kRates),
    // What is no parameter.
    {Kind::kChoice, "estimator", "constraint", "msckf", ""},
    {Kind::kChoice, "estimator", "observer", "odometry", ""},
    {Kind::kSection, "", "observer_fusion", "odometry_fusion", ""},
    {Kind::kOption, "replay", "--observer-profile", "--odometry-profile", ""},
    {Kind::kOption, "replay", "--budget-ms", "--image-ms", ""},
    {Kind::kOption, "make_world", "--observer-profile", "--odometry-profile", ""},
    {Kind::kOption, "make_bag", "--observer-profile", "--odometry-profile", ""},
    {Kind::kOption, "simulate_landmarks", "--observer-profile", "--odometry-profile", ""},
    {Kind::kLaunchArgument, "vslam.launch", "observer_fusion", "odometry_fusion", ""},
    {Kind::kLaunchArgument, "replay.launch", "observer_fusion", "odometry_fusion", ""},
    {Kind::kLaunchArgument, "ardrone.launch", "observer_fusion", "odometry_fusion", ""},
    {Kind::kLaunchArgument, "ardrone.launch", "observer_mode", "odometry_mode", ""},
    {Kind::kLaunchArgument, "ardrone.launch", "observer_profile", "odometry_profile", ""},
    {Kind::kNode, "", "observer_fusion_node", "odometry_fusion_node", ""},
    {Kind::kNode, "", "ObserverFusionNodelet", "OdometryFusionNodelet", ""},
};

}  // namespace

const std::vector<OldName>& oldNames() {
  static const std::vector<OldName> kAll(std::begin(kTable), std::end(kTable));
  return kAll;
}

std::string whatBecameOf(OldName::Kind kind, const std::string& name, const std::string& owner) {
  for (const OldName& old : kTable) {
    if (old.kind != kind || old.name != name || (!owner.empty() && old.owner != owner)) continue;
    const std::string why = old.why;
    if (*old.now == '\0') return "; it is no parameter any more: " + why;
    return "; " + name + " is called " + old.now + " now" + (why.empty() ? "" : ", " + why);
  }
  return {};
}

std::string remedyFor(const std::string& section, const std::string& written,
                      const std::set<std::string>& known) {
  std::string became = whatBecameOf(OldName::Kind::kParameter, written, section);
  if (!became.empty()) return became;
  const std::string nearest = nearestName(written, known);
  return nearest.empty() ? "" : "; did you mean " + section + "/" + nearest;
}

}  // namespace ardrone_vslam
