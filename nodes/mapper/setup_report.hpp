// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/DiagnosticStatusWrapper.h>

#include <optional>
#include <string>

#include "ardrone_vslam/setup_watch.hpp"
#include "ardrone_vslam/time_offset.hpp"
#include "conversions/conversions.hpp"
#include "timing/warning_limiter.hpp"

namespace ardrone_vslam {

/// What the images and the odometry say of the set-up: its faults, and which image_time_offset_s
/// would be better. Each is said once.
class SetupReport {
 public:
  /// @param used_s  the parameter image_time_offset_s
  SetupReport(double used_s, Warnings& warnings) : used_s_(used_s), warnings_(warnings) {}

  /// @param base, camera  names of the frames
  void useCamera(const Eigen::Isometry3d& T_base_cam, const std::string& base,
                 const std::string& camera);
  /// One image. @pre useCamera() was called
  void see(const ImageFeatures& features, const OdometryBuffer& odometries);
  /// @pre useCamera() was called
  const SetupFinding& finding() const { return setup_->finding(); }
  /// The fault that is found, and what helps; empty without one.
  const std::string& fault() const { return fault_; }

  void fill(Status& status) const;
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& wrapper) const;

 private:
  void sayFault();

  double used_s_;
  Warnings& warnings_;
  std::optional<TimeOffsetEstimator> time_offset_;
  std::optional<SetupWatch> setup_;
  std::string base_, camera_;
  std::string fault_;
  bool is_offset_told_ = false;
};

}  // namespace ardrone_vslam
