// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <string>

#include "ardrone_vslam/slam_config.hpp"
#include "configs/onboard_config.hpp"

/// What the nodelets read beside the stages' own parameters. Offline tools pass over these keys
/// (tools/config_files/config_file.cpp; a test holds the two lists together).
namespace ardrone_vslam {

enum class ImageTransport { kRaw, kCompressed };
template <>
struct EnumNames<ImageTransport> {
  static constexpr std::array<const char*, 2> kNames{"raw", "compressed"};
};

/// Of the camera node.
struct CameraNodeConfig {
  std::string device = "/dev/video0";
  std::string camera;  // empty: what camera_info_manager has kept
  std::string camera_frame = "camera";
  double rate = 30;
};

template <class Visitor>
void visitParameters(CameraNodeConfig& c, Visitor&& visit) {
  visit(ParameterInfo{"device", "name", 0, 0,
                      "where images come from: /dev/videoN or N, the address of a stream, or the "
                      "full path of a video file, which begins when somebody listens"},
        c.device);
  visit(ParameterInfo{"camera", "name", 0, 0, kCalibrationFile}, c.camera);
  visit(ParameterInfo{"camera_frame", "name", 0, 0, kCameraFrame}, c.camera_frame);
  visit(ParameterInfo{"rate", "Hz", 0.1, 100, "images a second"}, c.rate);
}

struct TrackerNodeConfig {
  ImageTransport image_transport = ImageTransport::kRaw;
  bool rectified = false;
  bool rescale_calibration = false;
  NumberOrAuto image_time_offset_s;
  int queue_size = 5;
};

/// Texts of parameters that several nodelets have.
namespace effects {
constexpr const char* kQueue =
    "images (tracker) or their features (mapper) kept while it is busy; the oldest go first";
constexpr const char* kMapFrame = "frame of the poses and of the map";
constexpr const char* kOdomFrame = "frame of the odometry; empty: the odometry's header.frame_id";
constexpr const char* kBaseFrame = "frame of the robot; empty: the odometry's child_frame_id";
}  // namespace effects

template <class Visitor>
void visitParameters(TrackerNodeConfig& c, Visitor&& visit) {
  visit(
      ParameterInfo{"image_transport", "choice", 0, 0,
                    "raw: the topic `image`. compressed: `image`/compressed (JPEG)", turnFirst(20)},
      c.image_transport);
  visit(ParameterInfo{"rectified", "switch", 0, 0,
                      "the images are rectified: use camera_info's P, no distortion. Also read by "
                      "the offline tools, for bags",
                      turnFirst(21)},
        c.rectified);
  visit(ParameterInfo{"rescale_calibration", "switch", 0, 0,
                      "camera_info's K may be of another size than the images (half, double), as "
                      "ardrone_autonomy does not rescale it: its middle tells. Also read by the "
                      "offline tools, for bags"},
        c.rescale_calibration);
  visit(ParameterInfo{"image_time_offset_s", "s", -5, 5, kImageTimeOffset, turnFirst(2)},
        c.image_time_offset_s);
  visit(ParameterInfo{"queue_size", "images", 1, 10000, effects::kQueue}, c.queue_size);
}

/// Of MapperOutputs.
struct OutputsConfig {
  double transform_tolerance_s = 0.2;
  bool publish_tf = true;
};

template <class Visitor>
void visitParameters(OutputsConfig& c, Visitor&& visit) {
  visit(ParameterInfo{"transform_tolerance_s", "s", 0.0, 10.0,
                      "tf map -> odom is stamped this much after the image, so that it holds until "
                      "the next one"},
        c.transform_tolerance_s);
  visit(ParameterInfo{"publish_tf", "switch", 0, 0, "send tf map -> odom"}, c.publish_tf);
}

/// When a file gets the map in flight.
struct AutosaveConfig {
  double autosave_s = 60;

  /// @return 0: only at the end
  double period_s() const { return autosave_s > 0 ? std::max(autosave_s, 1.0) : 0; }
};

template <class Visitor>
void visitParameters(AutosaveConfig& c, Visitor&& visit) {
  visit(ParameterInfo{"autosave_s", "s", 0, 86400,
                      "how often `save_map` gets the map in flight: what a crash may cost. Also "
                      "read by vslam_onboard; below 1 counts as 1, 0: only at the end"},
        c.autosave_s);
}

struct MapperNodeConfig {
  std::string map_frame = "map";
  std::string odom_frame;  // empty: the odometry's header.frame_id
  std::string base_frame;  // empty: the odometry's child_frame_id
  double odometry_wait_s = 0.5;
  OutputsConfig outputs;
  std::string map_file;  // empty: none
  std::string save_map;  // empty: none
  AutosaveConfig autosave;
  int queue_size = 10;
};

template <class Visitor>
void visitParameters(MapperNodeConfig& c, Visitor&& visit) {
  visit(ParameterInfo{"map_frame", "name", 0, 0, effects::kMapFrame, turnFirst(22)}, c.map_frame);
  visit(ParameterInfo{"odom_frame", "name", 0, 0, effects::kOdomFrame, turnFirst(23)},
        c.odom_frame);
  visit(ParameterInfo{"base_frame", "name", 0, 0, effects::kBaseFrame, turnFirst(24)},
        c.base_frame);
  visit(
      ParameterInfo{"odometry_wait_s", "s", 0.0, 60.0,
                    "how long an image waits for its odometry and extrinsics before it is dropped"},
      c.odometry_wait_s);
  visitParameters(c.outputs, visit);
  visit(ParameterInfo{"map_file", "path", 0, 0,
                      "of an earlier flight, in whose map this one takes place; a relative path "
                      "begins in ~/.ros/maps (maps in ROS_HOME), where the service save_map writes "
                      "(docs/fly_again.md). Also read by vslam_onboard, where it begins in the "
                      "folder it is started in; empty: none"},
        c.map_file);
  visit(ParameterInfo{"save_map", "path", 0, 0,
                      "file that gets the flight's map, every `autosave_s` and at the end, unless "
                      "`localise_only`; relative paths as those of `map_file`. Also read by "
                      "vslam_onboard; empty: none"},
        c.save_map);
  visitParameters(c.autosave, visit);
  visit(ParameterInfo{"queue_size", "images", 1, 10000, effects::kQueue}, c.queue_size);
}

struct OdometryFusionNodeConfig {
  std::string map_frame = "map";
  std::string base_frame;  // empty: the odometry's child_frame_id
};

template <class Visitor>
void visitParameters(OdometryFusionNodeConfig& c, Visitor&& visit) {
  visit(ParameterInfo{"map_frame", "name", 0, 0, effects::kMapFrame, turnFirst(22)}, c.map_frame);
  visit(ParameterInfo{"base_frame", "name", 0, 0, effects::kBaseFrame, turnFirst(24)},
        c.base_frame);
}

struct OnboardBridgeConfig {
  std::string address = "0.0.0.0:5582";
  bool same_clock = false;
  std::string camera;
  std::string camera_frame = "camera";
  std::string map_frame = "map";
  std::string odom_frame = "odom";
  std::string base_frame = "base_link";
  bool publish_odom_tf = true;
  OutputsConfig outputs;
};

template <class Visitor>
void visitParameters(OnboardBridgeConfig& c, Visitor&& visit) {
  visit(ParameterInfo{"address", "name", 0, 0,
                      "ADDRESS:PORT of this computer, at which vslam_onboard's datagrams are "
                      "received (its `telemetry_address`). Address 0.0.0.0: at all; port 0: any "
                      "that is free, the log and the diagnostics say which"},
        c.address);
  visit(
      ParameterInfo{"same_clock", "switch", 0, 0,
                    "the drone's stamps are of this computer's time of day (`realtime_clock`, and "
                    "both synchronised): taken as they are; off: the fastest answers tell how far "
                    "the clocks are apart"},
      c.same_clock);
  visit(ParameterInfo{"camera", "name", 0, 0, kCalibrationFile}, c.camera);
  visit(ParameterInfo{"camera_frame", "name", 0, 0, kCameraFrame}, c.camera_frame);
  visit(ParameterInfo{"map_frame", "name", 0, 0, effects::kMapFrame, turnFirst(22)}, c.map_frame);
  visit(ParameterInfo{"odom_frame", "name", 0, 0, effects::kOdomFrame, turnFirst(23)},
        c.odom_frame);
  visit(ParameterInfo{"base_frame", "name", 0, 0, effects::kBaseFrame, turnFirst(24)},
        c.base_frame);
  visit(ParameterInfo{"publish_odom_tf", "switch", 0, 0,
                      "send tf odom -> base, the estimate that the answer started from; off where "
                      "another node sends it"},
        c.publish_odom_tf);
  visitParameters(c.outputs, visit);
}

}  // namespace ardrone_vslam
