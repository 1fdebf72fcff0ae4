// SPDX-License-Identifier: BSD-3-Clause
#include "run/offline_run.hpp"

#include <algorithm>
#include <utility>

namespace ardrone_vslam {

BackEnd::BackEnd(const SlamConfig& config, const Eigen::Isometry3d& T_base_cam,
                 const std::vector<OdometryState>& odometry, std::vector<RangeReading> ranges)
    : config_(config),
      slam_(config, T_base_cam),
      T_base_cam_(T_base_cam),
      setup_(config.image_time_offset_s),
      odometry_(config, odometry),
      heights_(config, std::move(ranges)) {
  setup_.useCamera(T_base_cam);
  run_.image_time_offset_told_s = config.image_time_offset_s;
}

void BackEnd::load(const SavedMap& map) {
  slam_.load(map);
  run_.is_in_loaded_map = true;
}

void BackEnd::changeCamera(const Eigen::Isometry3d& T_base_cam) {
  slam_.changeCamera(T_base_cam);
  if (recorder_) recorder_->useCamera(T_base_cam);
  T_base_cam_ = T_base_cam;
  setup_.useCamera(T_base_cam);
  watch_.reset();
  standstill_.reset();
  ++run_.camera_changes;
}

double BackEnd::process(const TrackedFrame& frame) {
  if (frame.other_camera) changeCamera(*frame.other_camera);
  OdometryState state;
  const std::int64_t exposed_ns = setup_.clock().exposed_ns(frame.features.stamp_ns);
  if (!odometry_.at(exposed_ns, state)) {
    ++run_.frames_without_odometry;
    return total_ms(frame.times_ms);
  }
  watch_.see(frame.features, Eigen::Isometry3d((state.T_odom_base * T_base_cam_).linear()));
  standstill_.see(frame.features, state.T_odom_base * T_base_cam_);
  run_.odometry_froze = run_.odometry_froze || standstill_.isStuck();
  state.height_m = heights_.at(state);
  state.stamp_ns = frame.features.stamp_ns;  // the pose keeps the image's stamp
  watchSetup(frame.features);
  RunFrame run_frame;
  run_frame.image_time_offset_ns = exposed_ns - frame.features.stamp_ns;
  run_frame.times_ms = frame.times_ms;
  StageTimer timer(run_frame.times_ms);
  run_frame.result = slam_.process(frame.features, state, timer.hook(), StageTimer::clock());
  if (recorder_) recorder_->see(frame.features, state, run_frame.result, slam_.landmarks());
  run_.frames.push_back(std::move(run_frame));
  return total_ms(run_.frames.back().times_ms);
}

void BackEnd::watchSetup(const ImageFeatures& features) {
  if (setup_.see(features, odometry_.buffer(), slam_))
    run_.time_offset_found_ns = features.stamp_ns;
  const SetupFinding found = setup_.finding();
  const bool is_fault = found.fault != SetupFault::kNone;
  if (is_fault || run_.setup.fault == SetupFault::kNone) run_.setup = found;
  if (is_fault && run_.setup_fault_ns == 0) run_.setup_fault_ns = features.stamp_ns;
}

RunResult BackEnd::result(bool is_finished, bool is_map_saved) const {
  RunResult run = run_;
  if (is_finished && recorder_) run.record = recorder_->record();
  if (is_map_saved && slam_.hasWholeMap()) {
    run.map = slam_.save().map();
    run.map->flight = run.record;
  }
  run.time_offset = setup_.clock().estimate();
  run.image_time_offset_s = setup_.clock().used_s();
  run.images_travel = watch_.isStuck();
  run.absurd_speed_m_s = odometry_.absurdSpeed_m_s();
  run.odometry_states_refused = odometry_.refused();
  run.odometry_faults = odometry_.faults();
  run.ranges_refused = heights_.input().refused();
  run.heights_missing = heights_.input().missing();
  run.heights_tilted = heights_.input().tilted();
  run.landmarks = slam_.landmarks();
  return run;
}

namespace {

std::int64_t countOf(const RunResult& run, SlamState state) {
  return std::count_if(run.frames.begin(), run.frames.end(),
                       [state](const RunFrame& frame) { return frame.result.state == state; });
}

}  // namespace

std::int64_t countDistrusted(const RunResult& run) {
  return countOf(run, SlamState::kDistrusted);
}

std::int64_t countSearching(const RunResult& run) {
  return countOf(run, SlamState::kSearchingMap);
}

}  // namespace ardrone_vslam
