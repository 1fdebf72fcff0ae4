// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>

#include <vector>

#include "conversions/markers.hpp"

namespace ardrone_vslam {

/// State and map as rviz draws them; made only for those who look.
class MapView {
 public:
  explicit MapView(ros::NodeHandle& nh);
  MapView(const MapView&) = delete;
  MapView& operator=(const MapView&) = delete;

  /// toStateMarkers(), of a status that is new.
  void publishState(const Status& status, const Eigen::Vector3d& base_map,
                    const Landmarks& landmarks);
  /// LandmarkMarkers::changes(); all after somebody has begun to look.
  void publishLandmarks(const Landmarks& landmarks, const std_msgs::Header& header,
                        const Eigen::Vector3d& base_map);

 private:
  LandmarkMarkers markers_;
  ros::Time shown_;  // stamp of the status that was sent last
  ros::Publisher state_;
  ros::Publisher landmarks_;  // last: calls markers_
};

}  // namespace ardrone_vslam
