// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/problem.h>

#include <Eigen/Geometry>
#include <array>
#include <initializer_list>
#include <vector>

#include "ardrone_vslam/flight_record.hpp"

namespace ardrone_vslam {

/// Errors of the keyframes' poses beside the record's, as residuals.hpp has them.
using KeyframeErrors = std::vector<std::array<double, 6>>;

/// What odometry and heights say of a flight's keyframes, and the slow errors that they say it
/// with: of the odometry's attitude, velocity and scale, of the cameras' extrinsics, of the floors.
class BundleOdometry {
 public:
  /// Adds all of it. All three must outlive this. @pre `record` has a keyframe
  /// @param poses  of the rig at each keyframe: base, turned by the error of the extrinsics
  BundleOdometry(const FlightRecord& record, KeyframeErrors& poses, ceres::Problem& problem);

  /// The error of the extrinsics at a keyframe; the identity where they are exact.
  Eigen::Matrix3d R_base_rig(std::size_t keyframe) const;
  double* scaleError() { return &scale_error_; }
  /// Of the last camera: a rotation vector, axes of base [rad]. None where they are exact.
  double* extrinsicsError() { return cameras_.empty() ? nullptr : cameras_.back().error.data(); }
  /// Errors of attitude and velocity, each of which hangs on the one before it.
  std::vector<double*> chain();

 private:
  using Vector = std::array<double, 3>;
  struct Extrinsics {
    Eigen::Isometry3d T_base_cam;
    Vector error{};  // a rotation vector, axes of base
  };

  void addExtrinsics();
  void addOdometry();
  Eigen::Matrix3d attitudeAxes_map(std::size_t keyframe) const;
  void addAttitude(std::size_t keyframe);
  void addStep(std::size_t to);
  void addHeights();
  void add(ceres::CostFunction* cost, std::initializer_list<double*> of);

  const FlightRecord& record_;
  KeyframeErrors& poses_;
  ceres::Problem& problem_;
  std::vector<Extrinsics> cameras_;         // empty: they are exact
  std::vector<std::size_t> camera_of_;      // each keyframe
  Eigen::Vector3d up_map_;                  // unit vector
  std::vector<Vector> biases_, attitudes_;  // of the odometry at the keyframes
  std::vector<double> floors_map_m_;
  double scale_error_ = 0;
};

}  // namespace ardrone_vslam
