// SPDX-License-Identifier: BSD-3-Clause
// What the mapper says of itself: status, warnings, diagnostics.
#include "mapper/mapper_nodelet.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::size_t kTrackerStages = 3;

}  // namespace

void MapperNodelet::warn(const std::string& topic, const std::string& fault) {
  const std::string sentence = topic + ": message not used: " + fault;
  if (limiter_.allows(sentence, ros::SteadyTime::now().toSec())) NODELET_WARN_STREAM(sentence);
}

void MapperNodelet::noteCovariance(const OdometryState& state) {
  if (!covariance_fault_.empty()) return;
  covariance_fault_ = covarianceFault(state);
  if (covariance_fault_.empty()) return;
  NODELET_WARN_STREAM(odometry_sub_.getTopic() << ": " << covariance_fault_);
}

void MapperNodelet::noteSpeed(const OdometryState& state) {
  if (speed_.absurd_m_s() > 0) return;
  speed_.see(state);
  if (speed_.absurd_m_s() == 0) return;
  NODELET_WARN_STREAM(
      explainSpeed("the odometry on " + odometry_sub_.getTopic(), speed_.absurd_m_s()));
}

void MapperNodelet::noteStep(double step_m) {
  if (step_m == 0) return;
  ++totals_.odometry_steps;
  const std::string sentence = explainStep("the odometry on " + odometry_sub_.getTopic(), step_m);
  if (limiter_.allows(sentence, ros::SteadyTime::now().toSec())) NODELET_WARN_STREAM(sentence);
}

void MapperNodelet::noteDistrust(SlamState state) {
  if (state != SlamState::kDistrusted) return;
  const std::string sentence = explain(state);
  if (limiter_.allows(sentence, ros::SteadyTime::now().toSec())) NODELET_WARN_STREAM(sentence);
}

void MapperNodelet::noteTimeOffset() {
  const std::string advice = adviceOn(time_offset_->estimate(), config_.image_time_offset_s);
  if (advice.empty() || is_time_offset_told_) return;
  is_time_offset_told_ = true;
  NODELET_WARN_STREAM(advice);
}

OdometryFaultCounts MapperNodelet::odometryFaults() const {
  OdometryFaultCounts faults = adapter_->faults();
  if (navdata_) add(navdata_->faults(), faults);
  return faults;
}

void MapperNodelet::noteOdometryFaults() {
  const OdometryFaultCounts faults = odometryFaults();
  for (std::size_t i = 0; i < kOdometryFaultCount; ++i) {
    const auto fault = static_cast<OdometryFault>(i);
    if (faults[i] == odometry_faults_[i] || !isWorthWarning(fault)) continue;
    const std::string sentence =
        "the odometry on " + odometry_sub_.getTopic() + " " + explain(fault);
    if (limiter_.allows(sentence, ros::SteadyTime::now().toSec())) NODELET_WARN_STREAM(sentence);
  }
  odometry_faults_ = faults;
}

void MapperNodelet::noteOdomFrame() {
  // The own observer's frame is in no tf: what is there is the driver's other integration.
  if (navdata_) return;
  if (!odom_frame_fault_.empty() || frames_.odom.empty() || frames_.base.empty()) return;
  odom_frame_fault_ =
      odomFrameFault(mounting_->tf().core(), frames_.map, frames_.odom, frames_.base);
  if (!odom_frame_fault_.empty()) NODELET_WARN_STREAM(odom_frame_fault_);
}

void MapperNodelet::publishStatus(const FrameResult& result, const Features& features) {
  Status status;
  toStatus(result, frames_.map, status);
  if (standstill_.isStuck()) {
    status.reason = explainStandstill(odometry_sub_.getTopic());
    if (limiter_.allows(status.reason, ros::SteadyTime::now().toSec())) {
      NODELET_WARN_STREAM(status.reason);
    }
  } else if (status.reason.empty() && speed_.absurd_m_s() > 0) {
    status.reason =
        explainSpeed("the odometry on " + odometry_sub_.getTopic(), speed_.absurd_m_s());
  }
  for (std::size_t i = 0; i < kStageCount; ++i) {
    status.stage.emplace_back(kStageNames[i]);
    status.stage_time.push_back(
        i < kTrackerStages ? features.stage_time[i]
                           : static_cast<float>(stage_clock_.milliseconds(static_cast<Stage>(i))));
  }
  fillTotals(status);
  status_pub_.publish(status);
  latest_ = status;
}

void MapperNodelet::refuseResult(const FrameResult& result, const Features& features) {
  ++totals_.results_not_finite;
  publishStatus(result, features);
  beginMapAnew(explain(result.state));  // last: it ends the life of the result
}

void MapperNodelet::publishWaiting() {
  Status status;
  status.header.stamp = ros::Time::now();
  status.header.frame_id = frames_.map;
  if (!has_features_) {
    status.state = Status::WAITING_FOR_FEATURES;
    status.state_name = "waiting_for_features";
    status.reason = "no features on " + features_sub_.getTopic() +
                    ": is the tracker running, and does it get images and camera_info? Its log "
                    "and diagnostics say";
  } else if (!extrinsics_fault_.empty()) {
    status.state = Status::WAITING_FOR_EXTRINSICS;
    status.state_name = "waiting_for_extrinsics";
    status.reason = extrinsics_fault_;
  } else {
    status.state = Status::WAITING_FOR_ODOMETRY;
    status.state_name = "waiting_for_odometry";
    const OdometryBuffer::Lookup miss = matcher_->lastMiss();
    status.reason =
        navdata_ && miss == OdometryBuffer::Lookup::kEmpty
            ? "no navdata has come on " + odometry_sub_.getTopic() +
                  " (ardrone_autonomy/Navdata): start the driver, or remap `navdata` to its topic "
                  "(launch files: navdata:=TOPIC)"
            : explain(miss, odometry_sub_.getTopic());
  }
  if (isReminderDue(++seconds_waiting_)) {
    NODELET_WARN_STREAM(status.state_name << ": " << status.reason);
  }
  if (slam_) status.landmarks = static_cast<std::uint32_t>(slam_->landmarks().size());
  fillTotals(status);
  status_pub_.publish(status);
  latest_ = status;
}

void MapperNodelet::fillTotals(Status& status) const {
  status.images = totals_.images;
  status.images_dropped = totals_.images_dropped;
  status.images_dropped_queue = totals_.images_dropped_queue;
  status.images_without_camera_info = totals_.images_without_camera_info;
  status.dropped_bad_message = totals_.dropped_bad_message;
  status.dropped_stamp = totals_.dropped_stamp;
  status.dropped_queue = totals_.dropped_queue;
  status.dropped_no_odometry = totals_.dropped_no_odometry;
  status.dropped_no_extrinsics = totals_.dropped_no_extrinsics;
  status.odometry_refused = totals_.odometry_refused;
  status.ranges_refused = heights_->refused();
  status.heights_missing = heights_->input().missing();
  status.heights_tilted = heights_->input().tilted();
  status.heights_rejected = totals_.heights_rejected;
  status.odometry_steps = totals_.odometry_steps;
  toStatus(odometryFaults(), status);
  toStatus(time_offset_ ? time_offset_->estimate() : TimeOffset{}, config_.image_time_offset_s,
           status);
  status.results_not_finite = totals_.results_not_finite;
  status.restarts = totals_.restarts;
  status.camera_changes = totals_.camera_changes;
}

void MapperNodelet::remindOfHeights() {
  if (!heights_->isUsed() || !has_answer_) return;
  heights_->countSecond();
  if (isReminderDue(heights_->secondsWithout())) NODELET_WARN_STREAM(heights_->missing());
}

void MapperNodelet::onSecond() {
  remindOfHeights();
  noteOdomFrame();
  if (has_answer_) {
    seconds_waiting_ = 0;
  } else {
    publishWaiting();
  }
  has_features_ = false;
  has_answer_ = false;
  diagnostics_->force_update();
}

void MapperNodelet::diagnose(diagnostic_updater::DiagnosticStatusWrapper& wrapper) {
  using diagnostic_msgs::DiagnosticStatus;
  const bool is_stuck = latest_.state == Status::WAITING_FOR_ODOMETRY ||
                        latest_.state == Status::WAITING_FOR_EXTRINSICS ||
                        latest_.state == Status::NOT_FINITE || standstill_.isStuck();
  const bool is_well = isWell(latest_.state) && speed_.absurd_m_s() == 0 &&
                       odom_frame_fault_.empty() && heights_->missing().empty();
  const auto level = is_stuck  ? DiagnosticStatus::ERROR
                     : is_well ? DiagnosticStatus::OK
                               : DiagnosticStatus::WARN;
  wrapper.summary(
      static_cast<unsigned char>(level),
      latest_.reason.empty() ? latest_.state_name : latest_.state_name + ": " + latest_.reason);
  wrapper.add("images answered", totals_.images);
  wrapper.add("images without odometry", totals_.dropped_no_odometry);
  wrapper.add("odometry messages refused", totals_.odometry_refused);
  wrapper.add("odometry steps", totals_.odometry_steps);
  const OdometryFaultCounts faults = odometryFaults();
  for (std::size_t i = 0; i < kOdometryFaultCount; ++i) {
    if (faults[i] > 0)
      wrapper.add(std::string("odometry fault ") + nameOf(static_cast<OdometryFault>(i)),
                  faults[i]);
  }
  if (!covariance_fault_.empty()) wrapper.add("odometry covariance", covariance_fault_);
  if (speed_.absurd_m_s() > 0) {
    wrapper.add("odometry speed",
                explainSpeed("the odometry on " + odometry_sub_.getTopic(), speed_.absurd_m_s()));
  }
  if (!odom_frame_fault_.empty()) wrapper.add("odometry frame", odom_frame_fault_);
  wrapper.add("tf transforms with a stamp that was there", mounting_->tf().repeated());
  wrapper.add("tf transforms older than all kept", mounting_->tf().tooOld());
  if (heights_->isUsed()) {
    wrapper.add("heights refused", heights_->refused());
    wrapper.add("images without a height", heights_->input().missing());
    if (!heights_->missing().empty()) wrapper.add(heights_->name(), heights_->missing());
    wrapper.add("heights rejected", totals_.heights_rejected);
    wrapper.add("scale error", latest_.scale_error);
    wrapper.add("scale deviation", latest_.scale_deviation);
  }
  if (time_offset_) {
    const TimeOffset& offset = time_offset_->estimate();
    const std::string advice = adviceOn(offset, config_.image_time_offset_s);
    if (offset.state == TimeOffsetState::kKnown) {
      wrapper.add("image time offset [s], estimated", offset.offset_s);
      wrapper.add("its deviation [s]", offset.deviation_s);
    } else {
      wrapper.add("image time offset [s], estimated", explain(offset.state));
    }
    if (!advice.empty()) wrapper.add("image time offset", advice);
  }
  wrapper.add("results not finite", totals_.results_not_finite);
  wrapper.add("camera changes", totals_.camera_changes);
  wrapper.add("landmarks", latest_.landmarks);
  wrapper.add("landmark matches", latest_.landmark_matches);
  wrapper.add("deviation [m]", latest_.deviation);
  if (latest_.fix_nis > 0)
    wrapper.add("squared deviations of fixes over expected", latest_.fix_nis);
}

}  // namespace ardrone_vslam
