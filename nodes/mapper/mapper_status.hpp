// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>

#include <string>

#include "inputs/extrinsics_tf.hpp"
#include "inputs/height_topic.hpp"
#include "mapper/features_topic.hpp"
#include "mapper/live_slam.hpp"
#include "mapper/mapper_parameters.hpp"
#include "mapper/odometry_topic.hpp"
#include "timing/clock_watch.hpp"

namespace ardrone_vslam {

/// What the mapper says of itself: status, diagnostics, and reminders of what it waits for. It
/// looks at the mapper's parts and changes none.
class MapperStatus {
 public:
  struct Parts {
    const FeaturesTopic& features;
    const OdometryTopic& odometry;
    const HeightTopic& heights;
    const ExtrinsicsTf& extrinsics;
    const FrameMatcher& matcher;
    const LiveSlam& slam;
    const MapperParameters& parameters;
  };

  MapperStatus(ros::NodeHandle nh, const ros::NodeHandle& private_nh, const std::string& name,
               const Parts& parts, Warnings& warnings);

  void publishAnswer(const FrameResult& result, const Features& features);
  /// To be called once a second; says what the mapper waits for.
  void endSecond(bool has_features, bool has_answer);
  /// As published last.
  const Status& latest() const { return latest_; }

 private:
  void publishWaiting(bool has_features, bool reminds);
  std::string whyNoOdometry() const;
  void publish(Status& status);
  void fillStages(const Features& features, Status& status) const;
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& wrapper);
  unsigned char level() const;
  void diagnoseHeights(diagnostic_updater::DiagnosticStatusWrapper& wrapper) const;

  Parts parts_;
  Warnings& warnings_;
  ros::Publisher publisher_;
  diagnostic_updater::Updater diagnostics_;
  Status latest_;
  bool is_blind_ = false;  // hardly a corner; said when that begins
  Reminder reminder_;
};

}  // namespace ardrone_vslam
