// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nodelet/nodelet.h>

#include <memory>
#include <string>
#include <vector>

#include "ardrone_vslam/delayed_fusion.hpp"
#include "inputs/odometry_intake.hpp"
#include "odometry_fusion/correction_queue.hpp"
#include "odometry_fusion/fusion_frames.hpp"
#include "odometry_fusion/fusion_outputs.hpp"
#include "odometry_fusion/fusion_status.hpp"
#include "timing/timers.hpp"
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

  /// One state from the adapter: into the buffer, and out as seen from map.
  void take(const OdometryState& state);

  FusionFrames frames_;
  FusionOutputs outputs_;
  Warnings warnings_{[this](const std::string& sentence) { NODELET_WARN_STREAM(sentence); }};

  std::string odometry_topic_;
  std::unique_ptr<OdometryIntake> intake_;
  std::unique_ptr<DelayedFusion> fusion_;
  std::unique_ptr<CorrectionQueue> corrections_;
  std::unique_ptr<FusionStatus> status_;
  // Last, as they call: they end first.
  ros::Subscriber odometry_sub_;
  ros::Subscriber correction_sub_;
  Timers timers_;
};

}  // namespace ardrone_vslam
