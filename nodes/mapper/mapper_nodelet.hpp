// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <nodelet/nodelet.h>

#include <memory>

#include "ardrone_vslam/slam.hpp"
#include "ardrone_vslam/time_offset.hpp"
#include "configs/node_config.hpp"
#include "conversions/conversions.hpp"
#include "input_checks/speed_watch.hpp"
#include "input_checks/standstill_watch.hpp"
#include "inputs/camera_identity.hpp"
#include "inputs/frame_matcher.hpp"
#include "inputs/height_topic.hpp"
#include "inputs/mounting.hpp"
#include "inputs/navdata_input.hpp"
#include "outputs/mapper_outputs.hpp"
#include "timing/stage_clock.hpp"
#include "timing/stamp_guard.hpp"
#include "timing/warning_limiter.hpp"

namespace ardrone_vslam {

/// Features and odometry in, fused pose and map out. All callbacks run in the nodelet's
/// single-threaded queue, so nothing here is locked; only TfInput has a thread of its own.
class MapperNodelet : public nodelet::Nodelet {
 private:
  void onInit() override;
  void readParameters();

  /// odometry, or navdata in its place.
  void subscribeOdometry();

  void onFeatures(const FeaturesConstPtr& features);
  void onOdometry(const nav_msgs::OdometryConstPtr& odometry);
  void onSecond();

  bool acceptFeatures(const Features& features);
  /// Says once that the odometry's covariance counts as not given, and why.
  void noteCovariance(const OdometryState& state);
  /// Says once that the odometry is too fast to be in metres.
  void noteSpeed(const OdometryState& state);
  void noteStep(double step_m);
  /// Says that the camera is left out.
  void noteDistrust(SlamState state);
  /// Says that another image_time_offset_s would be better.
  void noteTimeOffset();
  /// Every second.
  void remindOfHeights();
  OdometryFaultCounts odometryFaults() const;
  /// Says what the adapter has found since this was called last.
  void noteOdometryFaults();
  /// Says once that the odometry's frame is not the one that tf has.
  void noteOdomFrame();
  /// What of a message is ready goes to the matcher. @return the sentence when it is not used
  std::string takeOdometry(const OdometryState& message);
  void takeFrameNames(const nav_msgs::Odometry& odometry);
  /// Works on every image whose odometry has come.
  void processReady();
  void processFrame(const FrameMatcher::Frame& frame);
  Eigen::Isometry3d mapToOdomOfTf(const FrameResult& result) const;
  /// Answers an image whose pose is not finite: by its status alone.
  void refuseResult(const FrameResult& result, const Features& features);
  /// Makes the Slam, or has it change the camera, once the mounting of these features' camera is
  /// known. @return false while it is not
  bool prepareSlam(const Features& features);
  void useCamera(const CameraIdentity& camera, const Eigen::Isometry3d& T_base_cam);
  /// Time began again at this stamp: forgets what belongs to the run before.
  void restartAt(std::int64_t stamp_ns, const std::string& topic);
  void beginMapAnew(const std::string& why);

  /// A warning of a message that is not used, unless the same has just been said.
  void warn(const std::string& topic, const std::string& fault);
  void publishStatus(const FrameResult& result, const Features& features);
  void publishWaiting();
  void fillTotals(Status& status) const;
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& wrapper);

  MapperNodeConfig node_config_;
  SlamConfig config_;
  std::string tf_prefix_;

  ros::Subscriber features_sub_;
  ros::Subscriber odometry_sub_;
  ros::Publisher status_pub_;
  ros::WallTimer tick_timer_;
  ros::WallTimer map_timer_;
  ros::WallTimer second_timer_;
  std::unique_ptr<Mounting> mounting_;
  std::unique_ptr<diagnostic_updater::Updater> diagnostics_;
  std::unique_ptr<MapperOutputs> outputs_;

  std::unique_ptr<NavdataInput> navdata_;  // odometry_mode navdata
  std::unique_ptr<OdometryAdapter> adapter_;
  std::vector<OdometryState> ready_;       // from the adapter; kept for its memory
  OdometryFaultCounts odometry_faults_{};  // those that were said
  std::unique_ptr<FrameMatcher> matcher_;
  std::unique_ptr<HeightTopic> heights_;
  std::unique_ptr<Slam> slam_;
  std::unique_ptr<TimeOffsetEstimator> time_offset_;
  Eigen::Isometry3d T_base_cam_ = Eigen::Isometry3d::Identity();  // as slam_ has it
  StandstillWatch standstill_;
  SpeedWatch speed_;
  StampGuard stamps_;
  GapCounter gaps_;
  StageClock stage_clock_;
  std::int64_t answered_ns_ = 0;  // stamp of the newest image in the map
  ImageFeatures features_;        // of the image at work; kept for its memory
  Frames frames_;                 // odom and base are empty until the first odometry
  CameraIdentity camera_;         // as slam_ has it
  std::string extrinsics_fault_;  // what tf says while the mounting is unknown

  Status totals_;  // its counters only
  Status latest_;  // as published last
  WarningLimiter limiter_;
  std::string covariance_fault_;  // of the odometry, since the first such message
  std::string odom_frame_fault_;  // since it was seen
  int seconds_waiting_ = 0;
  bool is_time_offset_told_ = false;
  bool has_features_ = false;  // within this second
  bool has_answer_ = false;
};

}  // namespace ardrone_vslam
