// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ardrone_vslam/Features.h>
#include <ardrone_vslam/PoseCorrection.h>
#include <ardrone_vslam/Status.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/Range.h>

#include <string>
#include <vector>

#include "ardrone_vslam/delayed_fusion.hpp"
#include "ardrone_vslam/features.hpp"
#include "ardrone_vslam/height_input.hpp"
#include "ardrone_vslam/landmark.hpp"
#include "ardrone_vslam/odometry_buffer.hpp"
#include "ardrone_vslam/odometry_faults.hpp"
#include "ardrone_vslam/slam.hpp"
#include "ardrone_vslam/time_offset.hpp"
#include "input_checks/checked.hpp"
#include "with_ros/camera_info_conversion.hpp"
#include "with_ros/geometry_conversion.hpp"

/// The only place of the nodelets, with geometry_conversion.hpp and its neighbours, that sees both
/// messages and the core's types. Everything that comes in is checked here, so that the core is
/// only ever given what its headers ask for.
namespace ardrone_vslam {

// --- in -----------------------------------------------------------------------------------------

/// As toUnboundedState, within rangeFault's bounds.
Checked<OdometryState> toOdometryState(const nav_msgs::Odometry& odometry);

/// Its range is not looked at: HeightInput knows what is one.
Checked<RangeReading> toRangeReading(const sensor_msgs::Range& message);

/// Poses with normalised quaternions, within faultOf(LateCorrection)'s bounds. The frames are not
/// looked at.
Checked<LateCorrection> toLateCorrection(const PoseCorrection& message);

/// A click of rviz. A covariance that tells nothing (zero, not finite) is that of rviz.
/// @param map_frame  that it must be in
Checked<PlaceHint> toPlaceHint(const geometry_msgs::PoseWithCovarianceStamped& message,
                               const std::string& map_frame);

/// @return what is wrong with the message (sizes, values not finite, bearings not of unit length),
/// or nothing
std::string faultOf(const Features& message);

/// @pre faultOf(message) is empty
void toFeatures(const Features& message, ImageFeatures& features);

// --- out ----------------------------------------------------------------------------------------

/// @param camera_frame  the camera's optical frame
void toMessage(const ImageFeatures& features, const std::string& camera_frame, Features& message);

/// Names of the three frames of REP-105.
struct Frames {
  std::string map;
  std::string odom;
  std::string base;
};

/// The fused pose of base in map.
geometry_msgs::PoseWithCovarianceStamped toPoseMessage(const FrameResult& result,
                                                       const Frames& frames);
/// The same as odometry; the twist (of base, axes of base) is the odometry's.
/// @param odometry  at the same stamp
nav_msgs::Odometry toOdometryMessage(const FrameResult& result, const Frames& frames,
                                     const OdometryState& odometry);
/// Live odometry seen from map; the twist (of base, axes of base) is the odometry's.
nav_msgs::Odometry toOdometryMessage(const MapState& state, const Frames& frames);
/// The odometry's state as a driver would send it.
nav_msgs::Odometry toOdometryMessage(const OdometryState& state, const std::string& odom_frame,
                                     const std::string& base_frame);
PoseCorrection toCorrectionMessage(const FrameResult& result, const Eigen::Isometry3d& T_map_odom,
                                   const Frames& frames);
/// Fills the state, its name and the reason.
void toStatus(SlamState state, const LeftOut& left_out, Status& status);
/// Puts a sentence before the reason; an empty one: nothing.
void sayFirst(const std::string& sentence, Status& status);
/// Near a plain wall, say: the image tells nothing, whatever the state.
bool hasHardlyACorner(const FrameResult& result);
/// Fills the state and the counts of one frame; leaves stage times and totals alone.
void toStatus(const FrameResult& result, const std::string& map_frame, Status& status);
void toStatus(const OdometryFaultCounts& faults, Status& status);
/// @param used_s  the offset in use
void toStatus(const TimeOffset& estimate, double used_s, Status& status);

/// Whether a pose of this state (of Status) is one to go by.
bool isWell(std::uint8_t state);

/// Landmarks as a cloud: x y z [m], deviation [m], times_seen, id.
sensor_msgs::PointCloud2 toCloud(const Landmarks& landmarks, const std::string& map_frame,
                                 std::int64_t stamp_ns);

}  // namespace ardrone_vslam
