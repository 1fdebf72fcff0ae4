// SPDX-License-Identifier: BSD-3-Clause
#include "outputs/map_view.hpp"

namespace ardrone_vslam {

using visualization_msgs::MarkerArray;

MapView::MapView(ros::NodeHandle& nh)
    : state_(nh.advertise<MarkerArray>("state_markers", 1)),
      // Of changes none may be lost.
      landmarks_(nh.advertise<MarkerArray>(
          "landmark_markers", 100,
          [this](const ros::SingleSubscriberPublisher&) { markers_.forget(); })) {}

void MapView::publishState(const Status& status, const Eigen::Vector3d& base_map,
                           const Landmarks& landmarks) {
  if (state_.getNumSubscribers() == 0 || status.header.stamp == shown_ ||
      status.header.frame_id.empty())
    return;
  shown_ = status.header.stamp;
  state_.publish(toStateMarkers(status, base_map, landmarks));
}

void MapView::publishLandmarks(const Landmarks& landmarks, const std_msgs::Header& header,
                               const Eigen::Vector3d& base_map) {
  if (landmarks_.getNumSubscribers() == 0) return;
  const MarkerArray changes = markers_.changes(landmarks, header, base_map);
  if (!changes.markers.empty()) landmarks_.publish(changes);
}

}  // namespace ardrone_vslam
