// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/Odometry.h>
#include <ros/node_handle.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "inputs/extrinsics_tf.hpp"
#include "inputs/frame_matcher.hpp"
#include "inputs/odometry_intake.hpp"
#include "inputs/odometry_maker.hpp"
#include "mapper/mapper_parameters.hpp"
#include "mapper/odometry_watch.hpp"

namespace ardrone_vslam {

/// The odometry, or the navdata in its place: what of it is ready goes to the matcher. Knows the
/// frames that it names.
class OdometryTopic {
 public:
  struct Calls {
    std::function<void(std::int64_t stamp_ns)> restart;  ///< time began again at this stamp
    std::function<void()> taken;                         ///< the matcher may have more now
  };

  /// @param tf  outlives this. @throws ConfigError
  OdometryTopic(ros::NodeHandle& nh, const ExtrinsicsTf& tf, const MapperSettings& settings,
                FrameMatcher& matcher, Warnings& warnings, Calls calls);
  /// Callbacks run in the queue of `nh`, at once.
  void subscribe(ros::NodeHandle& nh);

  const std::string& name() const { return name_; }
  /// Whether the package makes it of navdata, of which name() is then the topic.
  bool isNavdata() const;
  /// Whether poses are in the driver's frame odom; else they were integrated anew, or moved where
  /// it jumped.
  bool isInDriversFrame() const;
  /// Those of odom and base are empty until the first odometry.
  const Frames& frames() const { return frames_; }
  /// Which of them the odometry does not name, and what helps; else empty.
  std::string framesFault() const;
  /// To be called once a second.
  void seeTf(const tf2::BufferCore& tf);
  OdometryWatch& watch() { return watch_; }
  const OdometryWatch& watch() const { return watch_; }

  void fill(Status& status) const;
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& wrapper) const;

 private:
  void make(ros::NodeHandle& nh, const ExtrinsicsTf& tf);
  void onOdometry(const nav_msgs::OdometryConstPtr& odometry);
  /// @return the sentence when the message is not used
  std::string take(const OdometryState& message);
  void takeFrameNames(const nav_msgs::Odometry& odometry);
  void refuse(const std::string& topic, const std::string& fault);
  OdometryFaultCounts faults() const;

  const MapperSettings& settings_;
  FrameMatcher& matcher_;
  Warnings& warnings_;
  Calls calls_;
  std::string name_;
  OdometryWatch watch_;
  OdometryIntake intake_;
  std::unique_ptr<OdometryMaker> maker_;  // odometry_mode navdata or imu
  ros::Subscriber subscriber_;            // without a maker
  Frames frames_;
  std::uint64_t refused_ = 0;
};

}  // namespace ardrone_vslam
