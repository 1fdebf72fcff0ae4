// SPDX-License-Identifier: BSD-3-Clause
#include "inputs/odometry_maker.hpp"

#include <boost/make_shared.hpp>
#include <utility>

#include "conversions/conversions.hpp"
#include "conversions/frame_names.hpp"

namespace ardrone_vslam {

OdometryMaker::OdometryMaker(ros::NodeHandle& nh, Frames frames, Take take, Refuse refuse)
    : frames_(std::move(frames)),
      take_(std::move(take)),
      refuse_(std::move(refuse)),
      odometry_pub_(nh.advertise<nav_msgs::Odometry>("observer_odometry", kQueue)) {}

void OdometryMaker::handOn(std::vector<OdometryState>& ready) {
  for (const OdometryState& state : ready) {
    const auto odometry = boost::make_shared<nav_msgs::Odometry>(
        toOdometryMessage(state, withTfPrefix(frames_.tf_prefix, frames_.odom),
                          withTfPrefix(frames_.tf_prefix, frames_.base)));
    odometry_pub_.publish(odometry);
    take_(odometry);
  }
  ready.clear();
}

}  // namespace ardrone_vslam
