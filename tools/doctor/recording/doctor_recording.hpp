// SPDX-License-Identifier: BSD-3-Clause
// What doctor's checks work on: all that a bag or some seconds of live topics tell, without ROS.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "ardrone_vslam/camera_model.hpp"
#include "ardrone_vslam/drone_observer.hpp"
#include "ardrone_vslam/odometry_buffer.hpp"

namespace ardrone_vslam {

/// Of a message: what its header says, and when it was recorded or came in.
struct DoctorTime {
  std::int64_t stamp_ns = 0;
  std::int64_t received_ns = 0;
};

struct DoctorImage {
  DoctorTime time;
  std::string frame;  ///< without a leading slash, as all frames here
  int width_px = 0;
  int height_px = 0;
  std::string fault;  ///< why its pixels cannot be used; empty: they can
};

/// A camera_info's contents, each kept once.
struct DoctorCalibration {
  CameraIntrinsics camera;  ///< as it stands there, zeros for an uncalibrated one
  std::string fault;        ///< why the tracker refuses it; empty: it does not
  /// What rescale_calibration makes of it; nothing: the tracker refuses that, too.
  std::optional<CameraIntrinsics> rescaled = std::nullopt;
  bool operator==(const DoctorCalibration& o) const {
    return camera == o.camera && fault == o.fault && rescaled == o.rescaled;
  }
};

struct DoctorCameraInfo {
  DoctorTime time;
  std::size_t calibration = 0;  ///< index into the recording's
};

struct DoctorOdometry {
  DoctorTime time;
  std::optional<OdometryState> state;  ///< nothing: not finite, no rotation, or no stamp
};

/// A packet of the drone; nothing without a stamp.
struct DoctorNavdata {
  DoctorTime time;
  std::optional<NavdataReading> reading;
};

struct DoctorImu {
  DoctorTime time;
  std::optional<DroneImu> reading;
};

struct DoctorTransform {
  std::string parent;
  Eigen::Isometry3d T_parent_child = Eigen::Isometry3d::Identity();  ///< the newest
  std::string other_parent;  ///< that the child has at times as well; empty: none
};

struct DoctorTopic {
  std::string type;
  std::size_t messages = 0;
};

struct DoctorRecording {
  std::string name;      ///< of the bag, for messages
  bool is_live = false;  ///< there is no bag
  std::map<std::string, DoctorTopic> topics;
  std::string image_topic;  ///< empty: there is none, as for the next four
  std::string camera_info_topic;
  std::string odometry_topic;
  std::string navdata_topic;  ///< the driver's, or this package's copy of its type
  std::string imu_topic;
  std::vector<std::string> choices;         ///< sentences: which topic was taken among several
  std::vector<std::string> replay_options;  ///< that make replay take the same

  std::vector<DoctorImage> images;
  std::vector<DoctorCalibration> calibrations;
  std::vector<DoctorCameraInfo> camera_infos;
  std::vector<DoctorOdometry> odometry;
  std::string odom_frame;  ///< of the first odometry message
  std::string base_frame;  ///< likewise, or of the first navdata
  std::vector<DoctorNavdata> navdata;
  std::vector<DoctorImu> imu;
  std::map<std::string, DoctorTransform> transforms;  ///< by child

  /// 8-bit grey of an image without fault; empty when it cannot be decoded. May be slow.
  std::function<cv::Mat(std::size_t image)> grey;
};

/// Whether navdata stands in for odometry, which there is none of (odometry_mode navdata).
bool isNavdataTheOdometry(const DoctorRecording& recording);
/// Of odometry, else of navdata; empty: there is neither.
const std::string& odometryTopic(const DoctorRecording& recording);

/// T_from_to: takes coordinates of `to` to `from`, wherever in the tree the two
/// are. @return nothing when they are not connected
std::optional<Eigen::Isometry3d> lookUp(const DoctorRecording& recording, const std::string& from,
                                        const std::string& to);
/// Whether tf says anything of a frame.
bool isInTree(const DoctorRecording& recording, const std::string& frame);

}  // namespace ardrone_vslam
