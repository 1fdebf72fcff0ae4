// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nodelet/nodelet.h>

#include <memory>
#include <string>

#include "inputs/extrinsics_tf.hpp"
#include "inputs/frame_matcher.hpp"
#include "inputs/height_topic.hpp"
#include "mapper/features_topic.hpp"
#include "mapper/live_slam.hpp"
#include "mapper/map_services.hpp"
#include "mapper/mapper_parameters.hpp"
#include "mapper/mapper_status.hpp"
#include "mapper/odometry_topic.hpp"
#include "outputs/mapper_outputs.hpp"
#include "timing/timers.hpp"
#include "timing/warning_limiter.hpp"

namespace ardrone_vslam {

/// Features and odometry in, fused pose and map out. All callbacks run in the nodelet's
/// single-threaded queue, so nothing here is locked; only TfInput has a thread of its own.
class MapperNodelet : public nodelet::Nodelet {
 private:
  void onInit() override;
  void readParameters();
  const MapperSettings& settings() const { return parameters_->atStart(); }
  void makeMaps();
  void makeInputs();
  void start();

  /// Works on every image whose odometry has come.
  void processReady();
  void processFrame(const FrameMatcher::Frame& frame);
  /// Makes the Slam, or has it change the camera, once the extrinsics of these features' camera is
  /// known. @return false while it is not
  bool prepareSlam(const Features& features);
  void useCamera(const CameraIdentity& camera, const Eigen::Isometry3d& T_base_cam,
                 const std::string& frame);
  Eigen::Isometry3d mapToOdomOfTf(const FrameResult& result) const;
  /// Time began again at this stamp: forgets what belongs to the run before.
  void restartAt(std::int64_t stamp_ns, const std::string& topic);
  void beginMapAnew(const std::string& why);
  void onSecond();

  Warnings warnings_{[this](const std::string& sentence) { NODELET_WARN_STREAM(sentence); }};
  std::unique_ptr<MapperParameters> parameters_;
  std::unique_ptr<MapperOutputs> outputs_;
  std::unique_ptr<ExtrinsicsTf> extrinsics_;
  std::unique_ptr<LiveSlam> slam_;
  std::unique_ptr<MapServices> maps_;
  std::unique_ptr<FrameMatcher> matcher_;
  std::unique_ptr<MapperStatus> status_;
  // Last, as they call: they end first.
  std::unique_ptr<HeightTopic> heights_;
  std::unique_ptr<OdometryTopic> odometry_;
  std::unique_ptr<FeaturesTopic> features_;
  Timers timers_;
};

}  // namespace ardrone_vslam
