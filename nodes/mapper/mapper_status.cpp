// SPDX-License-Identifier: BSD-3-Clause
#include "mapper/mapper_status.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::size_t kTrackerStages = 3;

}  // namespace

MapperStatus::MapperStatus(ros::NodeHandle nh, const ros::NodeHandle& private_nh,
                           const std::string& name, const Parts& parts, Warnings& warnings)
    : parts_(parts),
      warnings_(warnings),
      publisher_(nh.advertise<Status>("status", 100)),
      diagnostics_(nh, private_nh, name) {
  diagnostics_.setHardwareID("none");
  diagnostics_.add("mapper", this, &MapperStatus::diagnose);
}

void MapperStatus::publishAnswer(const FrameResult& result, const Features& features) {
  const OdometryWatch& watch = parts_.odometry.watch();
  Status status;
  toStatus(result, parts_.odometry.frames().map, status);
  const bool was_blind = is_blind_;
  is_blind_ = hasHardlyACorner(result);
  if (is_blind_ && !was_blind) warnings_.limited(status.reason);
  if (!parts_.slam.setup().fault().empty()) {
    status.reason = parts_.slam.setup().fault();
  } else if (watch.isStuck()) {
    status.reason = explainStandstill(parts_.odometry.name());
    warnings_.limited(status.reason);
  } else if (status.reason.empty()) {
    status.reason = watch.speedFault();
  }
  sayFirst(explain(result.left_out), status);
  fillStages(features, status);
  publish(status);
}

void MapperStatus::fillStages(const Features& features, Status& status) const {
  for (std::size_t i = 0; i < kStageCount; ++i) {
    status.stage.emplace_back(kStageNames[i]);
    status.stage_time.push_back(
        i < kTrackerStages ? features.stage_time[i]
                           : static_cast<float>(parts_.slam.milliseconds(static_cast<Stage>(i))));
  }
}

void MapperStatus::publish(Status& status) {
  parts_.features.fill(status);
  parts_.odometry.fill(status);
  parts_.slam.fill(status);
  status.dropped_no_odometry = parts_.matcher.droppedNoOdometry();
  status.dropped_no_extrinsics = parts_.matcher.droppedHeld();
  status.ranges_refused = parts_.heights.refused();
  status.heights_missing = parts_.heights.input().missing();
  status.heights_tilted = parts_.heights.input().tilted();
  const std::string changed = parts_.parameters.changed();
  if (!changed.empty() && !status.changed_parameters.empty()) status.changed_parameters += ' ';
  status.changed_parameters += changed;
  publisher_.publish(status);
  latest_ = status;
}

void MapperStatus::endSecond(bool has_features, bool has_answer) {
  const bool reminds = reminder_.isDue(!has_answer);
  if (!has_answer) publishWaiting(has_features, reminds);
  diagnostics_.force_update();
}

void MapperStatus::publishWaiting(bool has_features, bool reminds) {
  Status status;
  status.header.stamp = ros::Time::now();
  status.header.frame_id = parts_.odometry.frames().map;
  if (!has_features) {
    status.state = Status::WAITING_FOR_FEATURES;
    status.state_name = "waiting_for_features";
    status.reason = "no features on " + parts_.features.name() +
                    ": is the tracker running, and does it get images and camera_info? Its log "
                    "and diagnostics say";
  } else if (!parts_.extrinsics.fault().empty()) {
    status.state = Status::WAITING_FOR_EXTRINSICS;
    status.state_name = "waiting_for_extrinsics";
    status.reason = parts_.extrinsics.fault();
  } else {
    status.state = Status::WAITING_FOR_ODOMETRY;
    status.state_name = "waiting_for_odometry";
    status.reason = whyNoOdometry();
  }
  if (reminds) warnings_.say(status.state_name + ": " + status.reason);
  if (parts_.slam.hasMap())
    status.landmarks = static_cast<std::uint32_t>(parts_.slam.slam().landmarks().size());
  publish(status);
}

std::string MapperStatus::whyNoOdometry() const {
  const std::string& topic = parts_.odometry.name();
  const OdometryBuffer::Lookup miss = parts_.matcher.lastMiss();
  if (parts_.odometry.isNavdata() && miss == OdometryBuffer::Lookup::kEmpty)
    return "no navdata has come on " + topic +
           " (ardrone_autonomy/Navdata): start the driver, or remap `navdata` to its topic "
           "(launch files: navdata:=TOPIC)";
  return explain(miss, topic);
}

unsigned char MapperStatus::level() const {
  using diagnostic_msgs::DiagnosticStatus;
  const OdometryWatch& watch = parts_.odometry.watch();
  if (latest_.state == Status::WAITING_FOR_ODOMETRY ||
      latest_.state == Status::WAITING_FOR_EXTRINSICS || latest_.state == Status::NOT_FINITE ||
      watch.isStuck() || !parts_.slam.setup().fault().empty())
    return DiagnosticStatus::ERROR;
  const bool is_well = isWell(latest_.state) && watch.isWell() && parts_.heights.missing().empty();
  return is_well ? DiagnosticStatus::OK : DiagnosticStatus::WARN;
}

void MapperStatus::diagnose(diagnostic_updater::DiagnosticStatusWrapper& wrapper) {
  wrapper.summary(level(), latest_.reason.empty() ? latest_.state_name
                                                  : latest_.state_name + ": " + latest_.reason);
  const LiveSlam::Counts& counts = parts_.slam.counts();
  wrapper.add("images answered", counts.images);
  wrapper.add("images without odometry", parts_.matcher.droppedNoOdometry());
  parts_.odometry.diagnose(wrapper);
  wrapper.add("tf transforms with a stamp that was there", parts_.extrinsics.tf().repeated());
  wrapper.add("tf transforms older than all kept", parts_.extrinsics.tf().tooOld());
  if (parts_.heights.isUsed()) diagnoseHeights(wrapper);
  parts_.slam.setup().diagnose(wrapper);
  wrapper.add("results not finite", counts.results_not_finite);
  wrapper.add("camera changes", counts.camera_changes);
  for (std::size_t i = 0; i < counts.left_out.size(); ++i) {
    if (counts.left_out[i] > 0)
      wrapper.add(std::string("images without time for ") + kOptionalWorkNames[i],
                  counts.left_out[i]);
  }
  if (!latest_.changed_parameters.empty())
    wrapper.add("parameters changed in flight", latest_.changed_parameters);
  wrapper.add("landmarks", latest_.landmarks);
  wrapper.add("landmark matches", latest_.landmark_matches);
  wrapper.add("deviation [m]", latest_.deviation);
  if (latest_.fix_nis > 0)
    wrapper.add("squared deviations of fixes over expected", latest_.fix_nis);
  if (latest_.track_nis > 0)
    wrapper.add("squared deviations of tracks over expected", latest_.track_nis);
  if (latest_.velocity_bias_deviation > 0)
    wrapper.add("velocity bias of the odometry, learned [m/s]", latest_.velocity_bias_deviation);
  if (latest_.yaw_walk_factor > 0)
    wrapper.add("drift of the odometry's yaw, learned, over configured", latest_.yaw_walk_factor);
}

void MapperStatus::diagnoseHeights(diagnostic_updater::DiagnosticStatusWrapper& wrapper) const {
  const HeightTopic& heights = parts_.heights;
  wrapper.add("heights refused", heights.refused());
  wrapper.add("images without a height", heights.input().missing());
  if (!heights.missing().empty()) wrapper.add(heights.name(), heights.missing());
  wrapper.add("heights rejected", parts_.slam.counts().heights_rejected);
  wrapper.add("scale error", latest_.scale_error);
  wrapper.add("scale deviation", latest_.scale_deviation);
}

}  // namespace ardrone_vslam
