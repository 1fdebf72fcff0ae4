// SPDX-License-Identifier: BSD-3-Clause
#include "mapper/odometry_topic.hpp"

#include <utility>

#include "conversions/frame_names.hpp"
#include "inputs/imu_input.hpp"
#include "inputs/navdata_input.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::uint32_t kQueue = 2000;  // 10 s at 200 Hz, while the mapper is busy

OdometryMode modeOf(const MapperSettings& settings) {
  return settings.slam.odometry_adapter.mode;
}

}  // namespace

OdometryTopic::OdometryTopic(ros::NodeHandle& nh, const ExtrinsicsTf& tf,
                             const MapperSettings& settings, FrameMatcher& matcher,
                             Warnings& warnings, Calls calls)
    : settings_(settings),
      matcher_(matcher),
      warnings_(warnings),
      calls_(std::move(calls)),
      name_(nh.resolveName(modeOf(settings) == OdometryMode::kNavdata ? "navdata" : "odometry")),
      watch_(name_, warnings),
      intake_(settings.slam.odometry_adapter) {
  frames_.map = withTfPrefix(settings.tf_prefix, settings.node.map_frame);
  make(nh, tf);
}

void OdometryTopic::make(ros::NodeHandle& nh, const ExtrinsicsTf& tf) {
  const OdometryMaker::Frames frames{settings_.node.odom_frame, settings_.node.base_frame,
                                     settings_.tf_prefix};
  const auto taken = [this](const nav_msgs::OdometryConstPtr& odometry) { onOdometry(odometry); };
  const auto refused = [this](const std::string& topic, const std::string& fault) {
    refuse(topic, fault);
  };
  if (modeOf(settings_) == OdometryMode::kNavdata) {
    maker_ = std::make_unique<NavdataInput>(nh, frames, taken, refused);
  } else if (modeOf(settings_) == OdometryMode::kImu) {
    maker_ = std::make_unique<ImuInput>(nh, frames, tf, taken, refused);
  }
}

void OdometryTopic::subscribe(ros::NodeHandle& nh) {
  if (maker_) return maker_->subscribe(nh);
  subscriber_ = nh.subscribe("odometry", kQueue, &OdometryTopic::onOdometry, this,
                             ros::TransportHints().tcpNoDelay());
}

bool OdometryTopic::isNavdata() const {
  return modeOf(settings_) == OdometryMode::kNavdata;
}

bool OdometryTopic::isInDriversFrame() const {
  if (modeOf(settings_) != OdometryMode::kPose) return false;
  const OdometryFaultCounts& counts = intake_.faults();
  for (const auto fault : {OdometryFault::kJump, OdometryFault::kReset, OdometryFault::kTurn})
    if (counts[static_cast<std::size_t>(fault)] > 0) return false;
  return true;
}

void OdometryTopic::onOdometry(const nav_msgs::OdometryConstPtr& odometry) {
  const auto checked = toUnboundedState(*odometry);
  std::string fault = checked.fault;
  if (checked.value) {
    const StampGuard::Answer answer = intake_.check(checked.value->stamp_ns);
    if (answer == StampGuard::Answer::kRestart) calls_.restart(checked.value->stamp_ns);
    fault = answer == StampGuard::Answer::kAlone ? kAloneFault : take(*checked.value);
    watch_.seeFaults(faults());
    if (fault.empty()) {
      takeFrameNames(*odometry);
      watch_.seeMessage(*checked.value);
    }
    calls_.taken();
  }
  if (!fault.empty()) refuse(name(), fault);
}

std::string OdometryTopic::take(const OdometryState& message) {
  std::string fault = intake_.take(message);
  for (const OdometryState& state : intake_.ready()) {
    const OdometryBuffer::Push answer = matcher_.addOdometry(state);
    if (answer == OdometryBuffer::Push::kAccepted) {
      watch_.seeState(state);
    } else {
      fault = explain(answer, state);
    }
  }
  return fault;
}

void OdometryTopic::takeFrameNames(const nav_msgs::Odometry& odometry) {
  const auto chosen = [this](const std::string& parameter, const std::string& header) {
    return withTfPrefix(settings_.tf_prefix, parameter.empty() ? header : parameter);
  };
  frames_.odom = chosen(settings_.node.odom_frame, odometry.header.frame_id);
  frames_.base = chosen(settings_.node.base_frame, odometry.child_frame_id);
}

std::string OdometryTopic::framesFault() const {
  if (!frames_.odom.empty() && frames_.odom == frames_.map)
    return "the frame of " + name() + " is called " + frames_.map +
           " as well as the map's: set the parameter map_frame to another name, such as vslam_map";
  if (!frames_.odom.empty() && !frames_.base.empty()) return {};
  return name() + " names no " +
         (frames_.odom.empty() ? "frame_id; set the parameter odom_frame"
                               : "child_frame_id; set the parameter base_frame");
}

void OdometryTopic::seeTf(const tf2::BufferCore& tf) {
  // The own observer's frame is in no tf: what is there is the driver's other integration.
  if (!isNavdata()) watch_.seeFrames(tf, frames_);
}

void OdometryTopic::fill(Status& status) const {
  status.odometry_refused = refused_;
  status.odometry_steps = watch_.steps();
  toStatus(faults(), status);
}

void OdometryTopic::diagnose(diagnostic_updater::DiagnosticStatusWrapper& wrapper) const {
  wrapper.add("odometry messages refused", refused_);
  wrapper.add("odometry steps", watch_.steps());
  const OdometryFaultCounts counts = faults();
  for (std::size_t i = 0; i < kOdometryFaultCount; ++i) {
    if (counts[i] > 0)
      wrapper.add(std::string("odometry fault ") + nameOf(static_cast<OdometryFault>(i)),
                  counts[i]);
  }
  watch_.diagnose(wrapper);
}

void OdometryTopic::refuse(const std::string& topic, const std::string& fault) {
  ++refused_;
  warnings_.refuse(topic, fault);
}

OdometryFaultCounts OdometryTopic::faults() const {
  OdometryFaultCounts faults = intake_.faults();
  if (maker_) add(maker_->faults(), faults);
  return faults;
}

}  // namespace ardrone_vslam
