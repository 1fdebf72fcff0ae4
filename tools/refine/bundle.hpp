// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/ceres.h>

#include <Eigen/Geometry>
#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "ardrone_vslam/flight_record.hpp"
#include "refine/track_points.hpp"

namespace ardrone_vslam {

/// The least squares problem of a whole flight: poses of its keyframes, slow errors of its
/// odometry, heights of its floors, and the points that it saw.
class Bundle {
 public:
  /// @param record  must outlive this. @pre it has a keyframe
  explicit Bundle(const FlightRecord& record);

  /// Minimises, with views that are off by more than about `most_sigmas` counting ever less.
  /// @param step  called after each iteration. @throws std::runtime_error when it cannot be solved
  void solve(double most_sigmas, const std::function<void()>& step);
  /// Leaves out views that are off by more, and points that too few are left of.
  void drop(double most_sigmas);

  Eigen::Isometry3d T_map_base(std::size_t keyframe) const;
  std::vector<TrackPoint3d> points() const;
  /// Of the odometry's scale error, and of position [m] and attitude (a rotation vector, axes of
  /// map) [rad] of each of these keyframes. To be called last: views are weighed by all that they
  /// share from then on. @throws std::runtime_error when nothing tells it
  /// @param keyframes  each once
  Eigen::MatrixXd covariance(const std::vector<std::size_t>& keyframes);
  std::size_t views() const;                        ///< that count
  std::size_t dropped() const { return dropped_; }  ///< and those left out

 private:
  using Vector = std::array<double, 3>;
  struct View {
    ceres::ResidualBlockId residual;
    std::unique_ptr<ceres::LossFunctionWrapper> weight;
  };

  void addOdometry();
  void addStep(std::size_t to);
  void addHeights();
  void addViews();
  void weighViews(double most_common_px);
  std::vector<double*> pointBlocks();
  void add(ceres::CostFunction* cost, std::initializer_list<double*> of);

  const FlightRecord& record_;
  ceres::LossFunctionWrapper loss_;
  ceres::Problem problem_;
  std::vector<std::array<double, 6>> poses_;  // errors beside the record's poses, see residuals.hpp
  std::vector<Vector> biases_, attitudes_;    // of the odometry at the keyframes
  std::vector<double> floors_map_m_;
  double scale_error_ = 0;
  std::vector<TrackPoint3d> points_;
  std::vector<std::vector<View>> views_of_;  // of each point
  std::size_t dropped_ = 0;
};

}  // namespace ardrone_vslam
