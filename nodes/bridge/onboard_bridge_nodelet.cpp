// SPDX-License-Identifier: BSD-3-Clause
#include "bridge/onboard_bridge_nodelet.hpp"

#include <cv_bridge/cv_bridge.h>
#include <sensor_msgs/image_encodings.h>

#include <pluginlib/class_list_macros.hpp>

#include "conversions/frame_names.hpp"
#include "conversions/onboard_conversion.hpp"
#include "from_ros/params.hpp"
#include "outputs/debug_image.hpp"
#include "protocol/clocks.hpp"
#include "protocol/udp.hpp"
#include "yaml/calibration.hpp"

namespace ardrone_vslam {
namespace {

constexpr int kStop_ms = 100;  // how late the thread may notice that it is to end
constexpr std::size_t kLargestDatagram = 65536;
constexpr std::uint32_t kQueue = 100;
constexpr int kPort = 5582;

}  // namespace

OnboardBridgeNodelet::~OnboardBridgeNodelet() {
  is_stopping_ = true;
  if (receiver_.joinable()) receiver_.join();
}

void OnboardBridgeNodelet::onInit() {
  readParameters();
  openSocket();
  ros::NodeHandle& nh = getNodeHandle();
  outputs_ = std::make_unique<MapperOutputs>(nh, config_.outputs);
  broadcaster_ = std::make_unique<tf2_ros::TransformBroadcaster>();
  status_pub_ = nh.advertise<Status>("status", kQueue);
  if (camera_) {
    features_pub_ = nh.advertise<Features>("features", kQueue);
    transport_ = std::make_unique<image_transport::ImageTransport>(nh);
    debug_pub_ = transport_->advertise("debug_image", 1);
  }
  diagnostics_ =
      std::make_unique<diagnostic_updater::Updater>(nh, getPrivateNodeHandle(), getName());
  diagnostics_->setHardwareID("none");
  diagnostics_->add("onboard_bridge", this, &OnboardBridgeNodelet::diagnose);
  const auto every = [&nh](double period_s, auto action) {
    return nh.createWallTimer(ros::WallDuration(period_s),
                              [action](const ros::WallTimerEvent&) { action(); });
  };
  second_timer_ = every(1.0, [this] { onSecond(); });
  map_timer_ = every(MapperOutputs::kMapPeriod_s, [this] {
    const std::lock_guard<std::mutex> lock(mutex_);
    outputs_->publishMap(stream_.telemetry().landmarks(), frames_.map);
  });
  receiver_ = std::thread([this] { receiveAll(); });
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
  try {
    if (!config_.camera.empty()) camera_.emplace(readCalibration(config_.camera));
  } catch (const std::exception& e) {
    NODELET_FATAL_STREAM(getName() << ": camera: " << e.what());
    throw;
  }
  const std::string prefix = tfPrefixOf(getPrivateNodeHandle());
  frames_ = {withTfPrefix(prefix, config_.map_frame), withTfPrefix(prefix, config_.odom_frame),
             withTfPrefix(prefix, config_.base_frame)};
  camera_frame_ = withTfPrefix(prefix, config_.camera_frame);
  NODELET_INFO_STREAM("ardrone_vslam " ARDRONE_VSLAM_VERSION " onboard_bridge: "
                      << reader.summary() << (prefix.empty() ? "" : " tf_prefix=" + prefix));
}

void OnboardBridgeNodelet::openSocket() {
  UdpAddress address;
  try {
    address = udpAddressOf(config_.address, kPort);
    socket_ = receiveAt(address);
  } catch (const std::runtime_error& e) {
    NODELET_FATAL_STREAM(getName() << ": " << e.what()
                                   << "; set `address` to one of this computer (0.0.0.0: all), and "
                                      "a port that no other program receives at");
    throw;
  }
  receiving_at_ = address.host + ":" + std::to_string(portOf(socket_.get()));
  NODELET_INFO_STREAM("receiving at " << receiving_at_);
}

void OnboardBridgeNodelet::receiveAll() {
  std::vector<std::uint8_t> datagram(kLargestDatagram);
  while (!is_stopping_) {
    if (!isReadable(socket_.get(), kStop_ms)) continue;
    const long size = receive(socket_, datagram.data(), datagram.size());
    if (size < 0) continue;
    const std::lock_guard<std::mutex> lock(mutex_);
    onDatagram(datagram.data(), static_cast<std::size_t>(size));
  }
}

void OnboardBridgeNodelet::warn(const std::string& sentence) {
  if (limiter_.allows(sentence, static_cast<double>(now_ns()) * 1e-9))
    NODELET_WARN_STREAM(sentence);
}

void OnboardBridgeNodelet::onDatagram(const std::uint8_t* datagram, std::size_t size) {
  const std::int64_t now = now_ns();
  const std::uint64_t restarts = stream_.counts().restarts;
  const DroneStream::Read read = stream_.read(datagram, size, now);
  if (stream_.counts().restarts > restarts) restart();
  if (read == DroneStream::Read::kNothing) {
    warn(receiving_at_ + ": datagram not used: " + explain(stream_.fault()));
    return;
  }
  heard_ns_ = now;
  if (read == DroneStream::Read::kPose) {
    onAnswer(stream_.pose());
  } else {
    onTelemetry();
  }
}

void OnboardBridgeNodelet::restart() {
  warn(
      "vslam_onboard was started again, or its clock set: the map begins anew; again and again: "
      "two "
      "programs send to " +
      receiving_at_);
  clock_.clear();
  drone_ns_ = 0;
  outputs_->clear();
}

std::optional<std::int64_t> OnboardBridgeNodelet::toOwnClock(std::int64_t drone_ns) {
  if (drone_ns < drone_ns_) return std::nullopt;
  if (drone_ns == drone_ns_) return own_ns_;
  drone_ns_ = drone_ns;
  if (config_.same_clock) {
    noteClock(drone_ns);
    own_ns_ = drone_ns;
  } else {
    own_ns_ = clock_.map(drone_ns, toNanoseconds(ros::Time::now()));
  }
  return own_ns_;
}

void OnboardBridgeNodelet::onAnswer(const VslamPose& pose) {
  Status status;
  toStatus(pose, status);
  status.header.stamp = ros::Time::now();
  if (beganMapAnew(pose)) outputs_->clear();
  const bool is_valid = (pose.flags & VSLAM_POSE_IS_VALID) != 0;
  const auto stamp_ns = is_valid ? toOwnClock(pose.stamp_ns) : std::nullopt;
  if (stamp_ns) {
    const FrameResult result = toFrameResult(pose, *stamp_ns);
    const Eigen::Isometry3d T_map_odom = result.T_map_base * result.T_odom_base.inverse();
    OdometryState observer;
    observer.stamp_ns = result.stamp_ns;
    observer.T_odom_base = result.T_odom_base;
    // The answer has no twist.
    observer.twist_covariance = kLargestTwistCovariance * Matrix6d::Identity();
    outputs_->publishFrame(result, T_map_odom, frames_, observer);
    outputs_->publishTf(result.stamp_ns, T_map_odom, frames_);
    publishOdomTf(result);
    ++poses_;
    seconds_without_pose_ = 0;
    status.header.stamp = toRosTime(*stamp_ns);
    status.deviation = result.sigma_m;
    status.features = static_cast<std::uint32_t>(stream_.telemetry().features().size());
  }
  publishStatus(status);
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
  if (stream_.telemetry().features().stamp_ns != drone_ns_) {
    ++telemetry_late_;
  } else if (camera_) {
    publishFeatures(own_ns_);
  }
}

void OnboardBridgeNodelet::publishFeatures(std::int64_t stamp_ns) {
  ImageFeatures features = stream_.telemetry().features();
  features.stamp_ns = stamp_ns;
  features_outside_ += addBearings(*camera_, features);
  Features message;
  toMessage(features, camera_frame_, message);
  features_pub_.publish(message);
  if (debug_pub_.getNumSubscribers() == 0) return;
  const cv::Mat black = cv::Mat::zeros(features.height_px, features.width_px, CV_8UC1);
  debug_pub_.publish(cv_bridge::CvImage(message.header, sensor_msgs::image_encodings::BGR8,
                                        drawFeatures(black, features))
                         .toImageMsg());
}

}  // namespace ardrone_vslam

PLUGINLIB_EXPORT_CLASS(ardrone_vslam::OnboardBridgeNodelet, nodelet::Nodelet)
