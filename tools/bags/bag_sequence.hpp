// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ardrone_vslam/odometry_config.hpp"
#include "bags/bag_findings.hpp"
#include "sequences/sequence.hpp"

namespace ardrone_vslam {

/// What to read of a bag. Empty names are found by type: the only topic of it, `truth` by its name.
struct BagReadOptions {
  std::string image_topic;  ///< sensor_msgs/Image or CompressedImage
  std::string camera_info_topic;
  std::string odometry_topic;  ///< nav_msgs/Odometry
  /// With navdata the package's own observer takes the odometry's place, with imu the attitude is
  /// the IMU's. The others are not the reader's.
  OdometryMode odometry_mode = OdometryMode::kPose;
  std::string navdata_topic;  ///< ardrone_autonomy/Navdata; read as odometry or for heights
  std::string imu_topic;      ///< sensor_msgs/Imu; with navdata there may be none
  std::string command_topic;  ///< geometry_msgs/Twist; there may be none
  std::string truth_topic;    ///< PoseStamped, PoseWithCovarianceStamped or Odometry, of base
  std::string range_topic;    ///< sensor_msgs/Range; read only with use_range
  bool use_range = false;
  bool use_navdata_height = false;  ///< the navdata's heights in the ranges' place
  std::string camera_frame;         ///< empty: the images' frame_id
  /// Empty: the odometry's child_frame_id; in a bag without odometry the camera's tf parent.
  std::string base_frame;
  bool rectified = false;  ///< the images are rectified: camera_info's P without distortion
  bool rescale_calibration = false;             ///< CameraInfoUse::rescale
  std::optional<CameraIntrinsics> camera;       ///< instead of camera_info
  std::optional<Eigen::Isometry3d> T_base_cam;  ///< instead of tf
};

/// A recorded bag; images may be asked for in any order.
class BagSequence : public Sequence {
 public:
  virtual const BagFindings& findings() const = 0;
};

/// Reads image (mono8, rgb8, bgr8, bayer, compressed), camera_info, odometry, truth, and base ->
/// camera from tf_static or tf. Messages with NaN or with stamps out of order are dropped and
/// counted, and so are images of another size than the calibration's.
/// @throws std::runtime_error naming bag or topic, the fault and the remedy
std::unique_ptr<BagSequence> openBag(const std::string& path, const BagReadOptions& options);

}  // namespace ardrone_vslam
