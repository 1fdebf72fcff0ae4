// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/DiagnosticStatusWrapper.h>

#include <string>

#include "ardrone_vslam/setup_monitor.hpp"
#include "conversions/conversions.hpp"
#include "timing/warning_limiter.hpp"

namespace ardrone_vslam {

/// What the images and the odometry say of the set-up: its faults, and the images' time offset.
/// Each is said once.
class SetupReport {
 public:
  /// @param offset_s  the parameter image_time_offset_s
  SetupReport(const NumberOrAuto& offset_s, Warnings& warnings)
      : monitor_(offset_s), warnings_(warnings) {}

  /// @param base, camera  names of the frames
  void useCamera(const Eigen::Isometry3d& T_base_cam, const std::string& base,
                 const std::string& camera);
  /// As SetupMonitor::see(). @pre useCamera() was called
  void see(const ImageFeatures& features, const OdometryBuffer& odometries, Slam& slam);
  const ImageClock& clock() const { return monitor_.clock(); }
  /// The fault that is found, and what helps; empty without one.
  const std::string& fault() const { return fault_; }

  void fill(Status& status) const;
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& wrapper) const;

 private:
  void sayFault();
  std::string offsetAdvice() const;

  SetupMonitor monitor_;
  Warnings& warnings_;
  std::string base_, camera_;
  std::string fault_;
  bool is_offset_told_ = false;
};

}  // namespace ardrone_vslam
