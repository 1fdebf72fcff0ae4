// SPDX-License-Identifier: BSD-3-Clause
#include "odometry_fusion/odometry_fusion_nodelet.hpp"

#include <pluginlib/class_list_macros.hpp>

#include "with_ros/params.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::uint32_t kOdometryQueue = 2000;  // 10 s at 200 Hz
constexpr std::uint32_t kCorrectionQueue = 100;

}  // namespace

void OdometryFusionNodelet::onInit() {
  readParameters();
  ros::NodeHandle& nh = getNodeHandle();
  outputs_.advertise(nh);
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
  OdometryFusionNodeConfig node_config;
  DelayedFusionConfig config;
  ParamReader reader(getPrivateNodeHandle());
  reader.read(node_config);
  reader.read(config);
  for (const auto& sentence : reader.unknownKeys()) NODELET_WARN_STREAM(sentence);
  try {
    reader.finish();
    fusion_ = std::make_unique<DelayedFusion>(config);
    intake_ = std::make_unique<OdometryIntake>(config.odometry_adapter);
  } catch (const ConfigError& e) {
    NODELET_FATAL_STREAM(getName() << ": " << e.what());
    throw;
  }
  const std::string tf_prefix = tfPrefixOf(getPrivateNodeHandle());
  frames_ = FusionFrames(node_config, tf_prefix);
  NODELET_INFO_STREAM("ardrone_vslam " ARDRONE_VSLAM_VERSION " odometry_fusion: "
                      << reader.summary() << (tf_prefix.empty() ? "" : " tf_prefix=" + tf_prefix));
}

void OdometryFusionNodelet::onOdometry(const nav_msgs::OdometryConstPtr& odometry) {
  status_->hearOdometry();
  const auto checked = toUnboundedState(*odometry);
  if (!checked.value) return status_->refuseOdometry(checked.fault);
  const OdometryState& message = *checked.value;
  const StampGuard::Answer answer = intake_->check(message.stamp_ns);
  if (answer == StampGuard::Answer::kAlone) return status_->refuseOdometry(kAloneFault);
  if (answer == StampGuard::Answer::kRestart) {
    status_->countRestart();
    warnings_.event("stamps on " + odometry_topic_ +
                    " jumped back (a bag plays again?): odometry and correction are forgotten, "
                    "nothing is published until the next correction");
    fusion_->clear();
    corrections_->clear();
  }
  frames_.see(odometry->child_frame_id);
  const std::string fault = intake_->take(message);
  if (!fault.empty()) status_->refuseOdometry(fault);
  for (const OdometryState& state : intake_->ready()) take(state);
}

void OdometryFusionNodelet::take(const OdometryState& state) {
  const std::string fault = explain(fusion_->push(state), state);
  if (!fault.empty()) return status_->refuseOdometry(fault);
  const bool is_corrected = corrections_->use();
  outputs_.publishLive(*fusion_, frames_.frames());
  if (is_corrected) outputs_.publishRepropagated(*fusion_, frames_.frames());
}

void OdometryFusionNodelet::onCorrection(const PoseCorrectionConstPtr& message) {
  status_->hearCorrection();
  const auto checked = toLateCorrection(*message);
  if (!checked.value) return status_->refuseCorrection(checked.fault);
  const std::string fault = frames_.faultOf(*message);
  if (!fault.empty()) return status_->refuseCorrection(fault);
  corrections_->add(*checked.value);
  if (corrections_->use()) outputs_.publishRepropagated(*fusion_, frames_.frames());
}

}  // namespace ardrone_vslam

PLUGINLIB_EXPORT_CLASS(ardrone_vslam::OdometryFusionNodelet, nodelet::Nodelet)
