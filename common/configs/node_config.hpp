// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "ardrone_vslam/parameters.hpp"

/// What the nodelets read beside the stages' own parameters. Offline tools pass over these keys
/// (tools/config_files/config_file.cpp; a test holds the two lists together).
namespace ardrone_vslam {

enum class ImageTransport { kRaw, kCompressed };
template <>
struct EnumNames<ImageTransport> {
  static constexpr std::array<const char*, 2> kNames{"raw", "compressed"};
};

struct TrackerNodeConfig {
  ImageTransport image_transport = ImageTransport::kRaw;
  bool rectified = false;
  bool rescale_calibration = false;
  double image_time_offset_s = 0;
  int queue_size = 5;
};

template <class Visitor>
void visitParameters(TrackerNodeConfig& c, Visitor&& visit) {
  visit(ParameterInfo{"image_transport", "choice", 0, 0,
                      "raw: the topic `image`; compressed: `image`/compressed"},
        c.image_transport);
  visit(ParameterInfo{"rectified", "switch", 0, 0,
                      "the images are rectified: use camera_info's P, no distortion"},
        c.rectified);
  visit(ParameterInfo{"rescale_calibration", "switch", 0, 0,
                      "camera_info's K may be of another size than the images (half, double), as "
                      "ardrone_autonomy does not rescale it: its middle tells"},
        c.rescale_calibration);
  visit(ParameterInfo{"image_time_offset_s", "s", -5, 5, "as the mapper's, for use_attitude"},
        c.image_time_offset_s);
  visit(ParameterInfo{"queue_size", "images", 1, 10000,
                      "images kept while the tracker is busy; the oldest go first"},
        c.queue_size);
}

/// Of MapperOutputs.
struct OutputsConfig {
  double transform_tolerance_s = 0.2;
  bool publish_tf = true;
  double map_publish_hz = 2.0;
  int max_path_poses = 5000;
};

template <class Visitor>
void visitParameters(OutputsConfig& c, Visitor&& visit) {
  visit(ParameterInfo{"transform_tolerance_s", "s", 0.0, 10.0,
                      "tf map -> odom is stamped this much after the image, so that it holds until "
                      "the next one"},
        c.transform_tolerance_s);
  visit(ParameterInfo{"publish_tf", "switch", 0, 0, "send tf map -> odom"}, c.publish_tf);
  visit(ParameterInfo{"map_publish_hz", "Hz", 0.01, 100.0,
                      "largest rate of paths, landmark cloud and markers"},
        c.map_publish_hz);
  visit(ParameterInfo{"max_path_poses", "poses", 1, 1000000,
                      "poses kept in each path; the oldest go first"},
        c.max_path_poses);
}

struct MapperNodeConfig {
  std::string map_frame = "map";
  std::string odom_frame;  // empty: the odometry's header.frame_id
  std::string base_frame;  // empty: the odometry's child_frame_id
  double odometry_wait_s = 0.5;
  OutputsConfig outputs;
  int queue_size = 10;
};

template <class Visitor>
void visitParameters(MapperNodeConfig& c, Visitor&& visit) {
  visit(ParameterInfo{"map_frame", "name", 0, 0, "frame of the poses and of the map"}, c.map_frame);
  visit(ParameterInfo{"odom_frame", "name", 0, 0, "empty: the odometry's header.frame_id"},
        c.odom_frame);
  visit(ParameterInfo{"base_frame", "name", 0, 0, "empty: the odometry's child_frame_id"},
        c.base_frame);
  visit(
      ParameterInfo{"odometry_wait_s", "s", 0.0, 60.0,
                    "how long an image waits for its odometry and extrinsics before it is dropped"},
      c.odometry_wait_s);
  visitParameters(c.outputs, visit);
  visit(ParameterInfo{"queue_size", "images", 1, 10000,
                      "images' features kept while the mapper is busy; the oldest go first"},
        c.queue_size);
}

struct OdometryFusionNodeConfig {
  std::string map_frame = "map";
  std::string base_frame;  // empty: the odometry's child_frame_id
};

template <class Visitor>
void visitParameters(OdometryFusionNodeConfig& c, Visitor&& visit) {
  visit(ParameterInfo{"map_frame", "name", 0, 0, "as the mapper's"}, c.map_frame);
  visit(ParameterInfo{"base_frame", "name", 0, 0, "empty: the odometry's child_frame_id"},
        c.base_frame);
}

struct OnboardBridgeConfig {
  std::string address = "0.0.0.0";
  int port = 5582;
  bool same_clock = false;
  double silent_s = 1.0;
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
                      "what vslam_onboard sends is received at this address of the computer; "
                      "0.0.0.0: at all"},
        c.address);
  visit(ParameterInfo{"port", "port", 0, 65535,
                      "and UDP port: vslam_onboard's telemetry_port; 0: any that is free, the log "
                      "and the diagnostics say which"},
        c.port);
  visit(
      ParameterInfo{"same_clock", "switch", 0, 0,
                    "the drone's stamps are of this computer's time of day (`realtime_clock`, and "
                    "both synchronised): taken as they are; off: the fastest answers tell how far "
                    "the clocks are apart"},
      c.same_clock);
  visit(ParameterInfo{"silent_s", "s", 0.001, 3600,
                      "without a datagram for so long the status says that the drone is silent"},
        c.silent_s);
  visit(ParameterInfo{"camera", "name", 0, 0,
                      "file of the camera's calibration, the same as vslam_onboard's: for bearings "
                      "and the image's size; empty: neither `features` nor `debug_image`"},
        c.camera);
  visit(ParameterInfo{"camera_frame", "name", 0, 0, "the camera's optical frame, of `features`"},
        c.camera_frame);
  visit(ParameterInfo{"map_frame", "name", 0, 0, "frame of the poses and of the map"}, c.map_frame);
  visit(ParameterInfo{"odom_frame", "name", 0, 0, "of the flight controller's own estimate"},
        c.odom_frame);
  visit(ParameterInfo{"base_frame", "name", 0, 0, "of the drone"}, c.base_frame);
  visit(ParameterInfo{"publish_odom_tf", "switch", 0, 0,
                      "send tf odom -> base, the estimate that the answer started from; off where "
                      "another node sends it"},
        c.publish_odom_tf);
  visitParameters(c.outputs, visit);
}

struct PathNodeConfig {
  int max_poses = 100000;
  double publish_hz = 2.0;
};

template <class Visitor>
void visitParameters(PathNodeConfig& c, Visitor&& visit) {
  visit(ParameterInfo{"max_poses", "poses", 1, 10000000, "the path begins anew beyond it"},
        c.max_poses);
  visit(ParameterInfo{"publish_hz", "Hz", 0.01, 100.0, "largest rate of the path"}, c.publish_hz);
}

}  // namespace ardrone_vslam
