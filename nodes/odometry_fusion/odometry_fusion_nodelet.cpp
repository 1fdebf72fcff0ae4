// SPDX-License-Identifier: BSD-3-Clause
#include "odometry_fusion/odometry_fusion_nodelet.hpp"

#include <nav_msgs/Path.h>

#include <algorithm>
#include <pluginlib/class_list_macros.hpp>

#include "conversions/frame_names.hpp"
#include "from_ros/params.hpp"
#include "inputs/frame_matcher.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::uint32_t kOdometryQueue = 2000;  // 10 s at 200 Hz, in and out
constexpr std::uint32_t kCorrectionQueue = 100;
constexpr std::size_t kMostWaiting = 1000;

}  // namespace

void OdometryFusionNodelet::onInit() {
  readParameters();
  ros::NodeHandle& nh = getNodeHandle();
  frames_.map = withTfPrefix(tf_prefix_, node_config_.map_frame);
  live_pub_ = nh.advertise<nav_msgs::Odometry>("odometry_live", kOdometryQueue);
  repropagated_pub_ = nh.advertise<nav_msgs::Path>("repropagated", 10);
  diagnostics_ =
      std::make_unique<diagnostic_updater::Updater>(nh, getPrivateNodeHandle(), getName());
  diagnostics_->setHardwareID("none");
  diagnostics_->add("odometry_fusion", this, &OdometryFusionNodelet::diagnose);
  second_timer_ = nh.createWallTimer(ros::WallDuration(1.0),
                                     [this](const ros::WallTimerEvent&) { onSecond(); });
  const auto no_delay = ros::TransportHints().tcpNoDelay();
  odometry_sub_ =
      nh.subscribe("odometry", kOdometryQueue, &OdometryFusionNodelet::onOdometry, this, no_delay);
  correction_sub_ = nh.subscribe("correction", kCorrectionQueue,
                                 &OdometryFusionNodelet::onCorrection, this, no_delay);
}

void OdometryFusionNodelet::readParameters() {
  ParamReader reader(getPrivateNodeHandle());
  reader.read(node_config_);
  reader.read(config_);
  for (const auto& sentence : reader.unknownKeys()) NODELET_WARN_STREAM(sentence);
  try {
    reader.finish();
    fusion_ = std::make_unique<DelayedFusion>(config_);
    adapter_ = std::make_unique<OdometryAdapter>(config_.odometry_adapter);
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
  has_odometry_ = true;
  const auto checked = toUnboundedState(*odometry);
  if (!checked.value) return refuseOdometry(checked.fault);
  const OdometryState& message = *checked.value;
  if (fusion_->newestStamp_ns() - message.stamp_ns >= StampGuard::kRestart_ns) {
    ++restarts_;
    NODELET_WARN_STREAM(
        "stamps on " << odometry_sub_.getTopic()
                     << " jumped back (a bag plays again?): odometry and correction are forgotten, "
                        "nothing is published until the next correction");
    fusion_->clear();
    waiting_.clear();
  }
  const std::string& base = node_config_.base_frame;
  frames_.base = withTfPrefix(tf_prefix_, base.empty() ? odometry->child_frame_id : base);
  ready_.clear();
  const std::string fault = ardrone_vslam::explain(adapter_->push(message, ready_), message);
  if (!fault.empty()) refuseOdometry(fault);
  for (const OdometryState& state : ready_) take(state);
}

void OdometryFusionNodelet::take(const OdometryState& state) {
  const std::string fault = ardrone_vslam::explain(fusion_->push(state), state);
  if (!fault.empty()) return refuseOdometry(fault);
  const bool is_corrected = useWaiting();
  if (const auto live = fusion_->newest()) live_pub_.publish(toOdometryMessage(*live, frames_));
  if (is_corrected) publishRepropagated();
}

void OdometryFusionNodelet::onCorrection(const PoseCorrectionConstPtr& message) {
  has_correction_ = true;
  const auto checked = toLateCorrection(*message);
  if (!checked.value) return refuseCorrection(checked.fault);
  const std::string fault = frameFault(*message);
  if (!fault.empty()) return refuseCorrection(fault);
  const std::int64_t stamp_ns = checked.value->stamp_ns;
  if (!waiting_.empty() && waiting_.back().stamp_ns - stamp_ns >= StampGuard::kRestart_ns) {
    // The mapper began anew: what it said of a later time is void.
    while (!waiting_.empty() && waiting_.back().stamp_ns >= stamp_ns) waiting_.pop_back();
  }
  const auto later = std::upper_bound(
      waiting_.begin(), waiting_.end(), stamp_ns,
      [](std::int64_t stamp, const LateCorrection& waiting) { return stamp < waiting.stamp_ns; });
  waiting_.insert(later, *checked.value);
  if (waiting_.size() > kMostWaiting) {
    waiting_.pop_front();
    refuseCorrection("too many corrections wait for odometry at their stamps");
  }
  if (useWaiting()) publishRepropagated();
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

bool OdometryFusionNodelet::useWaiting() {
  bool is_used = false;
  while (!waiting_.empty()) {
    const LateCorrection& correction = waiting_.front();
    const DelayedFusion::Answer answer = fusion_->correct(correction);
    if (answer == DelayedFusion::Answer::kNotYet) break;
    if (answer == DelayedFusion::Answer::kUsed) {
      is_used = true;
      ++corrections_used_;
    } else {
      if (answer == DelayedFusion::Answer::kTooOld) ++corrections_too_old_;
      refuseCorrection(explain(answer, correction));
    }
    waiting_.pop_front();
  }
  return is_used;
}

std::string OdometryFusionNodelet::explain(DelayedFusion::Answer answer,
                                           const LateCorrection& correction) const {
  const double late_s = static_cast<double>(fusion_->newestStamp_ns() - correction.stamp_ns) * 1e-9;
  switch (answer) {
    case DelayedFusion::Answer::kTooOld:
      return text("its image is ", late_s,
                  " s older than the newest odometry, and the odometry of that time is not kept; "
                  "raise odometry_buffer_s, or let the mapper do less");
    case DelayedFusion::Answer::kGap:
      return text("the odometry has a hole longer than half a second at its stamp");
    case DelayedFusion::Answer::kNotAfter:
      return "its stamp is not after that of the correction in use";
    case DelayedFusion::Answer::kOtherOdometry:
      return text("its observer_pose is not where ", odometry_sub_.getTopic(),
                  " was at its stamp; remap odometry to the mapper's topic, and set odometry_mode "
                  "and odometry_height as the mapper's");
    case DelayedFusion::Answer::kBad:
      return faultOf(correction);
    case DelayedFusion::Answer::kUsed:
    case DelayedFusion::Answer::kNotYet:
      break;
  }
  return {};
}

void OdometryFusionNodelet::refuseCorrection(const std::string& fault) {
  ++corrections_refused_;
  warn(correction_sub_.getTopic(), fault);
}

void OdometryFusionNodelet::refuseOdometry(const std::string& fault) {
  ++odometry_refused_;
  warn(odometry_sub_.getTopic(), fault);
}

void OdometryFusionNodelet::warn(const std::string& topic, const std::string& fault) {
  const std::string sentence = topic + ": message not used: " + fault;
  if (limiter_.allows(sentence, ros::SteadyTime::now().toSec())) NODELET_WARN_STREAM(sentence);
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

std::string OdometryFusionNodelet::waitingFor() const {
  if (!has_odometry_) {
    return "no odometry on " + odometry_sub_.getTopic() + ": nothing is published";
  }
  if (!has_correction_ && !fusion_->hasCorrection()) {
    return "no correction on " + correction_sub_.getTopic() +
           " yet: nothing is published; is the mapper running? Its status says why it waits";
  }
  if (!fusion_->hasCorrection()) return "no correction could be used; the warnings say why";
  if (!has_correction_) {
    return "no correction on " + correction_sub_.getTopic() +
           " for a second: the odometry drifts on from the last one";
  }
  return {};
}

void OdometryFusionNodelet::onSecond() {
  const std::string waiting = waitingFor();
  if (waiting != waited_for_) seconds_waiting_ = 0;
  waited_for_ = waiting;
  if (!waiting.empty()) ++seconds_waiting_;
  if (isReminderDue(seconds_waiting_)) NODELET_WARN_STREAM(waiting);
  diagnostics_->force_update();
  has_odometry_ = false;
  has_correction_ = false;
}

void OdometryFusionNodelet::diagnose(diagnostic_updater::DiagnosticStatusWrapper& wrapper) {
  using diagnostic_msgs::DiagnosticStatus;
  const std::string waiting = waitingFor();
  const auto level = waiting.empty()                             ? DiagnosticStatus::OK
                     : has_odometry_ && fusion_->hasCorrection() ? DiagnosticStatus::WARN
                                                                 : DiagnosticStatus::ERROR;
  wrapper.summary(static_cast<unsigned char>(level), waiting.empty() ? "publishing" : waiting);
  wrapper.add("corrections used", corrections_used_);
  wrapper.add("corrections refused", corrections_refused_);
  wrapper.add("of them older than the buffer", corrections_too_old_);
  wrapper.add("odometry messages refused", odometry_refused_);
  wrapper.add("restarts", restarts_);
  if (!fusion_->hasCorrection()) return;
  wrapper.add(
      "age of the correction [s]",
      static_cast<double>(fusion_->newestStamp_ns() - fusion_->correctionStamp_ns()) * 1e-9);
}

}  // namespace ardrone_vslam

PLUGINLIB_EXPORT_CLASS(ardrone_vslam::OdometryFusionNodelet, nodelet::Nodelet)
