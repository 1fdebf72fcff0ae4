// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <nodelet/nodelet.h>

#include <deque>
#include <memory>
#include <vector>

#include "ardrone_vslam/delayed_fusion.hpp"
#include "ardrone_vslam/odometry_adapter.hpp"
#include "configs/node_config.hpp"
#include "conversions/conversions.hpp"
#include "timing/stamp_guard.hpp"
#include "timing/warning_limiter.hpp"

namespace ardrone_vslam {

/// The live odometry and the mapper's late corrections in, odometry in map at the odometry's full
/// rate out. Sends no tf: map -> odom is the mapper's, odom -> base the odometry's. All callbacks
/// run in the nodelet's single-threaded queue.
class OdometryFusionNodelet : public nodelet::Nodelet {
 private:
  void onInit() override;
  void readParameters();

  void onOdometry(const nav_msgs::OdometryConstPtr& odometry);
  void onCorrection(const PoseCorrectionConstPtr& correction);
  void onSecond();

  /// One state from the adapter: into the buffer, and out as seen from map.
  void take(const OdometryState& state);
  /// What is wrong with the frames of a correction, and what helps; empty when nothing is.
  std::string frameFault(const PoseCorrection& correction) const;
  /// Uses the corrections whose odometry has come. @return whether there was one
  bool useWaiting();
  /// Why a correction was not used, and what helps.
  std::string explain(DelayedFusion::Answer answer, const LateCorrection& correction) const;
  void refuseCorrection(const std::string& fault);
  void refuseOdometry(const std::string& fault);
  void warn(const std::string& topic, const std::string& fault);
  /// What the node waits for; empty when it publishes.
  std::string waitingFor() const;
  void publishRepropagated();
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& wrapper);

  OdometryFusionNodeConfig node_config_;
  DelayedFusionConfig config_;
  std::string tf_prefix_;

  ros::Subscriber odometry_sub_;
  ros::Subscriber correction_sub_;
  ros::Publisher live_pub_;
  ros::Publisher repropagated_pub_;
  ros::WallTimer second_timer_;
  std::unique_ptr<diagnostic_updater::Updater> diagnostics_;

  std::unique_ptr<OdometryAdapter> adapter_;
  std::vector<OdometryState> ready_;  // from the adapter; kept for its memory
  std::unique_ptr<DelayedFusion> fusion_;
  std::deque<LateCorrection> waiting_;  // for their odometry; stamps ascend
  Frames frames_;                       // base is empty until the first odometry; odom is not used

  WarningLimiter limiter_;
  bool has_odometry_ = false;  // within this second
  bool has_correction_ = false;
  std::string waited_for_;  // in the second before
  int seconds_waiting_ = 0;
  std::uint64_t corrections_used_ = 0;
  std::uint64_t corrections_too_old_ = 0;  // counted in refused, too
  std::uint64_t corrections_refused_ = 0;
  std::uint64_t odometry_refused_ = 0;
  std::uint64_t restarts_ = 0;
};

}  // namespace ardrone_vslam
