// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/DiagnosticStatusWrapper.h>

#include <optional>

#include "ardrone_vslam/time_offset.hpp"
#include "conversions/conversions.hpp"
#include "timing/warning_limiter.hpp"

namespace ardrone_vslam {

/// Says once that another image_time_offset_s would be better, and what is known of it.
class TimeOffsetWatch {
 public:
  TimeOffsetWatch(double used_s, Warnings& warnings) : used_s_(used_s), warnings_(warnings) {}

  void useCamera(const Eigen::Isometry3d& T_base_cam);
  /// One image. @pre useCamera() was called
  void see(const ImageFeatures& features, const OdometryBuffer& odometries);

  void fill(Status& status) const;
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& wrapper) const;

 private:
  double used_s_;  // the parameter
  Warnings& warnings_;
  std::optional<TimeOffsetEstimator> estimator_;
  bool is_told_ = false;
};

}  // namespace ardrone_vslam
