// SPDX-License-Identifier: BSD-3-Clause
#include "bridge/onboard_bridge_nodelet.hpp"

#include <pluginlib/class_list_macros.hpp>
#include <utility>

#include "conversions/frame_names.hpp"
#include "conversions/onboard_conversion.hpp"
#include "protocol/clocks.hpp"
#include "with_ros/params.hpp"
#include "yaml/calibration.hpp"

namespace ardrone_vslam {

void OnboardBridgeNodelet::onInit() {
  readParameters();
  openSocket();
  ros::NodeHandle& nh = getNodeHandle();
  clock_ = std::make_unique<DroneClock>(config_.same_clock, warnings_);
  outputs_ = std::make_unique<MapperOutputs>(nh, config_.outputs);
  broadcaster_ = std::make_unique<tf2_ros::TransformBroadcaster>();
  status_ = std::make_unique<BridgeStatus>(
      nh, getPrivateNodeHandle(), BridgeStatus::Names{getName(), receiver_->at(), frames_.map},
      BridgeStatus::Parts{mutex_, stream_, *clock_, features_.get()}, warnings_);
  timers_.every(nh, 1.0, [this] { status_->endSecond(); });
  timers_.every(nh, MapperOutputs::kMapPeriod_s, [this] {
    const std::lock_guard<std::mutex> lock(mutex_);
    outputs_->publishMap(stream_.telemetry().landmarks(), frames_.map);
  });
  timers_.every(nh, MapperOutputs::kStatePeriod_s, [this] {
    const std::lock_guard<std::mutex> lock(mutex_);
    outputs_->publishState(status_->latest(), stream_.telemetry().landmarks());
  });
  receiver_->start([this](const std::uint8_t* datagram, std::size_t size) {
    const std::lock_guard<std::mutex> lock(mutex_);
    onDatagram(datagram, size);
  });
}

void OnboardBridgeNodelet::readParameters() {
  ParamReader reader(getPrivateNodeHandle());
  reader.read(config_);
  for (const auto& sentence : reader.unknownKeys()) NODELET_WARN_STREAM(sentence);
  try {
    reader.finish();
  } catch (const ConfigError& e) {
    NODELET_FATAL_STREAM(getName() << ": " << e.what());
    throw;
  }
  const std::string prefix = tfPrefixOf(getPrivateNodeHandle());
  readCamera(prefix);
  frames_ = {withTfPrefix(prefix, config_.map_frame), withTfPrefix(prefix, config_.odom_frame),
             withTfPrefix(prefix, config_.base_frame)};
  NODELET_INFO_STREAM("ardrone_vslam " ARDRONE_VSLAM_VERSION " onboard_bridge: "
                      << reader.summary() << (prefix.empty() ? "" : " tf_prefix=" + prefix));
}

void OnboardBridgeNodelet::readCamera(const std::string& tf_prefix) {
  if (config_.camera.empty()) return;
  try {
    features_ = std::make_unique<FeaturesOutput>(getNodeHandle(), readCalibration(config_.camera),
                                                 withTfPrefix(tf_prefix, config_.camera_frame));
  } catch (const std::exception& e) {
    NODELET_FATAL_STREAM(getName() << ": camera: " << e.what());
    throw;
  }
}

void OnboardBridgeNodelet::openSocket() {
  try {
    receiver_ = std::make_unique<DatagramReceiver>(config_.address);
  } catch (const std::runtime_error& e) {
    NODELET_FATAL_STREAM(getName() << ": " << e.what());
    throw;
  }
  NODELET_INFO_STREAM("receiving at " << receiver_->at());
}

void OnboardBridgeNodelet::onDatagram(const std::uint8_t* datagram, std::size_t size) {
  const std::uint64_t restarts = stream_.counts().restarts;
  const DroneStream::Read read = stream_.read(datagram, size, now_ns());
  if (stream_.counts().restarts > restarts) restart();
  if (read == DroneStream::Read::kNothing) {
    warnings_.limited(receiver_->at() + ": datagram not used: " + explain(stream_.fault()));
    return;
  }
  status_->hear();
  if (read == DroneStream::Read::kPose) {
    onAnswer(stream_.pose());
  } else {
    onTelemetry();
  }
}

void OnboardBridgeNodelet::restart() {
  warnings_.limited(
      "vslam_onboard was started again, or its clock set: the map begins anew; again and again: "
      "two programs send to " +
      receiver_->at());
  clock_->clear();
  outputs_->clear();
}

void OnboardBridgeNodelet::onAnswer(const VslamPose& pose) {
  Status status;
  toStatus(pose, status);
  status.header.stamp = ros::Time::now();
  if (beganMapAnew(pose)) outputs_->clear();
  const bool is_valid = (pose.flags & VSLAM_POSE_IS_VALID) != 0;
  const auto stamp_ns = is_valid ? clock_->toOwn(pose.stamp_ns) : std::nullopt;
  if (stamp_ns) {
    const FrameResult result = toFrameResult(pose, *stamp_ns);
    publishPose(result);
    status.header.stamp = toRosTime(*stamp_ns);
    status.deviation = result.sigma_m;
    status.features = static_cast<std::uint32_t>(stream_.telemetry().features().size());
  }
  status_->publishAnswer(status, stamp_ns.has_value());
}

void OnboardBridgeNodelet::publishPose(const FrameResult& result) {
  const Eigen::Isometry3d T_map_odom = result.T_map_base * result.T_odom_base.inverse();
  OdometryState odometry;
  odometry.stamp_ns = result.stamp_ns;
  odometry.T_odom_base = result.T_odom_base;
  // The answer has no twist.
  odometry.twist_covariance = kLargestTwistCovariance * Matrix6d::Identity();
  outputs_->publishFrame(result, T_map_odom, frames_, odometry);
  outputs_->publishTf(result.stamp_ns, T_map_odom, frames_);
  publishOdomTf(result);
}

void OnboardBridgeNodelet::publishOdomTf(const FrameResult& result) {
  if (!config_.publish_odom_tf) return;
  geometry_msgs::TransformStamped transform;
  transform.header.stamp = toRosTime(result.stamp_ns);
  transform.header.frame_id = frames_.odom;
  transform.child_frame_id = frames_.base;
  transform.transform = toTransform(result.T_odom_base);
  broadcaster_->sendTransform(transform);
}

void OnboardBridgeNodelet::onTelemetry() {
  // It comes behind its image's answer. Only answers tell the time: one wrong telemetry would mute
  // them.
  if (!clock_->isNewest(stream_.telemetry().features().stamp_ns)) {
    status_->countLateTelemetry();
  } else if (features_) {
    ImageFeatures features = stream_.telemetry().features();
    features.stamp_ns = clock_->newest_ns();
    features_->publish(std::move(features));
  }
}

}  // namespace ardrone_vslam

PLUGINLIB_EXPORT_CLASS(ardrone_vslam::OnboardBridgeNodelet, nodelet::Nodelet)
