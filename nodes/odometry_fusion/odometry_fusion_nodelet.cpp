// SPDX-License-Identifier: BSD-3-Clause
#include "odometry_fusion/odometry_fusion_nodelet.hpp"

#include <nav_msgs/Path.h>

#include <pluginlib/class_list_macros.hpp>

#include "conversions/frame_names.hpp"
#include "from_ros/params.hpp"
#include "inputs/frame_matcher.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::uint32_t kOdometryQueue = 2000;  // 10 s at 200 Hz, in and out
constexpr std::uint32_t kCorrectionQueue = 100;

}  // namespace

void OdometryFusionNodelet::onInit() {
  readParameters();
  ros::NodeHandle& nh = getNodeHandle();
  frames_.map = withTfPrefix(tf_prefix_, node_config_.map_frame);
  live_pub_ = nh.advertise<nav_msgs::Odometry>("odometry_live", kOdometryQueue);
  repropagated_pub_ = nh.advertise<nav_msgs::Path>("repropagated", 10);
  odometry_topic_ = nh.resolveName("odometry");
  corrections_ = std::make_unique<CorrectionQueue>(
      *fusion_, odometry_topic_,
      [this](const std::string& fault) { status_->refuseCorrection(fault); });
  status_ = std::make_unique<FusionStatus>(
      nh, getPrivateNodeHandle(), getName(),
      FusionStatus::Topics{odometry_topic_, nh.resolveName("correction")}, *fusion_, *corrections_,
      warnings_);
  timers_.every(nh, 1.0, [this] { status_->endSecond(); });
  // Last: callbacks run at once, in another thread.
  const auto no_delay = ros::TransportHints().tcpNoDelay();
  odometry_sub_ =
      nh.subscribe("odometry", kOdometryQueue, &OdometryFusionNodelet::onOdometry, this, no_delay);
  correction_sub_ = nh.subscribe("correction", kCorrectionQueue,
                                 &OdometryFusionNodelet::onCorrection, this, no_delay);
}

void OdometryFusionNodelet::readParameters() {
  DelayedFusionConfig config;
  ParamReader reader(getPrivateNodeHandle());
  reader.read(node_config_);
  reader.read(config);
  for (const auto& sentence : reader.unknownKeys()) NODELET_WARN_STREAM(sentence);
  try {
    reader.finish();
    fusion_ = std::make_unique<DelayedFusion>(config);
    adapter_ = std::make_unique<OdometryAdapter>(config.odometry_adapter);
  } catch (const ConfigError& e) {
    NODELET_FATAL_STREAM(getName() << ": " << e.what());
    throw;
  }
  tf_prefix_ = tfPrefixOf(getPrivateNodeHandle());
  NODELET_INFO_STREAM("ardrone_vslam " ARDRONE_VSLAM_VERSION " odometry_fusion: "
                      << reader.summary()
                      << (tf_prefix_.empty() ? "" : " tf_prefix=" + tf_prefix_));
}

void OdometryFusionNodelet::onOdometry(const nav_msgs::OdometryConstPtr& odometry) {
  status_->hearOdometry();
  const auto checked = toUnboundedState(*odometry);
  if (!checked.value) return status_->refuseOdometry(checked.fault);
  const OdometryState& message = *checked.value;
  if (fusion_->newestStamp_ns() - message.stamp_ns >= StampGuard::kRestart_ns) {
    status_->countRestart();
    NODELET_WARN_STREAM(
        "stamps on " << odometry_topic_
                     << " jumped back (a bag plays again?): odometry and correction are forgotten, "
                        "nothing is published until the next correction");
    fusion_->clear();
    corrections_->clear();
  }
  const std::string& base = node_config_.base_frame;
  frames_.base = withTfPrefix(tf_prefix_, base.empty() ? odometry->child_frame_id : base);
  ready_.clear();
  const std::string fault = explain(adapter_->push(message, ready_), message);
  if (!fault.empty()) status_->refuseOdometry(fault);
  for (const OdometryState& state : ready_) take(state);
}

void OdometryFusionNodelet::take(const OdometryState& state) {
  const std::string fault = explain(fusion_->push(state), state);
  if (!fault.empty()) return status_->refuseOdometry(fault);
  const bool is_corrected = corrections_->use();
  if (const auto live = fusion_->newest()) live_pub_.publish(toOdometryMessage(*live, frames_));
  if (is_corrected) publishRepropagated();
}

void OdometryFusionNodelet::onCorrection(const PoseCorrectionConstPtr& message) {
  status_->hearCorrection();
  const auto checked = toLateCorrection(*message);
  if (!checked.value) return status_->refuseCorrection(checked.fault);
  const std::string fault = frameFault(*message);
  if (!fault.empty()) return status_->refuseCorrection(fault);
  corrections_->add(*checked.value);
  if (corrections_->use()) publishRepropagated();
}

std::string OdometryFusionNodelet::frameFault(const PoseCorrection& correction) const {
  if (correction.header.frame_id != frames_.map) {
    return text("it is in the frame '", correction.header.frame_id, "', not in '", frames_.map,
                "'; set map_frame and tf_prefix as the mapper's");
  }
  if (!frames_.base.empty() && correction.child_frame_id != frames_.base) {
    return text("it is of '", correction.child_frame_id, "', the odometry of '", frames_.base,
                "'; remap odometry to the mapper's topic, or set base_frame as the mapper's");
  }
  return {};
}

void OdometryFusionNodelet::publishRepropagated() {
  if (repropagated_pub_.getNumSubscribers() == 0) return;
  nav_msgs::Path path;
  for (const MapState& state : fusion_->sinceCorrection()) {
    geometry_msgs::PoseStamped pose;
    pose.header.stamp = toRosTime(state.stamp_ns);
    pose.header.frame_id = frames_.map;
    pose.pose = toPose(state.T_map_base);
    path.poses.push_back(pose);
  }
  path.header.stamp = toRosTime(fusion_->correctionStamp_ns());
  path.header.frame_id = frames_.map;
  repropagated_pub_.publish(path);
}

}  // namespace ardrone_vslam

PLUGINLIB_EXPORT_CLASS(ardrone_vslam::OdometryFusionNodelet, nodelet::Nodelet)
