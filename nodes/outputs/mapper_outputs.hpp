// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/Path.h>
#include <ros/node_handle.h>
#include <tf2_ros/transform_broadcaster.h>

#include <deque>
#include <string>
#include <vector>

#include "configs/node_config.hpp"
#include "conversions/conversions.hpp"
#include "outputs/map_view.hpp"

namespace ardrone_vslam {

/// Everything that the mapper publishes beside its status; onboard_bridge, too.
class MapperOutputs {
 public:
  /// How often publishMap() is to be called: a large map twice a second leaves the link to others.
  static constexpr double kMapPeriod_s = 0.5;
  /// How often publishState().
  static constexpr double kStatePeriod_s = 0.2;

  MapperOutputs(ros::NodeHandle& nh, const OutputsConfig& config);
  void change(const OutputsConfig& config) { config_ = config; }

  /// Pose, odometry and correction of one image; remembers the path.
  /// @param odometry  at the image's stamp
  void publishFrame(const FrameResult& result, const Eigen::Isometry3d& T_map_odom,
                    const Frames& frames, const OdometryState& odometry);
  /// @param T_map_odom  for the odom -> base that is in tf
  void publishTf(std::int64_t stamp_ns, const Eigen::Isometry3d& T_map_odom, const Frames& frames);

  /// Paths, cloud and markers: large, so only to those who look, and only when there is something
  /// new. Called at a bounded rate.
  void publishMap(const Landmarks& landmarks, const std::string& map_frame);
  /// @param status  as published last
  void publishState(const Status& status, const Landmarks& landmarks);

  /// The map began anew: empties the paths.
  void clear();

 private:
  /// A topic whose message is built only for a subscriber and only after a change.
  struct OnDemand {
    ros::Publisher publisher;
    std::int64_t published_ns = 0;  // stamp of the content that was sent last
    std::uint32_t subscribers = 0;  // then

    bool isDue(std::int64_t newest_ns);
  };
  using Poses = std::deque<geometry_msgs::PoseStamped>;

  void remember(Poses& poses, const Eigen::Isometry3d& T_a_b, const Frames& frames);
  static nav_msgs::Path toPath(const Poses& poses);
  Eigen::Vector3d base_map() const;

  OutputsConfig config_;
  ros::Publisher pose_pub_;
  ros::Publisher odometry_pub_;
  ros::Publisher correction_pub_;
  OnDemand path_;
  OnDemand odometry_path_;
  OnDemand cloud_;
  MapView view_;
  tf2_ros::TransformBroadcaster broadcaster_;
  Poses fused_poses_;
  Poses odometry_poses_;
  std::int64_t newest_ns_ = 0;
};

}  // namespace ardrone_vslam
