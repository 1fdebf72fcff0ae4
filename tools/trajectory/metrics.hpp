// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "trajectory/trajectory.hpp"

namespace ardrone_vslam {

struct ErrorSummary {
  double rmse_m = 0;
  double mean_m = 0;
  double max_m = 0;
};

/// Position errors at equal stamps, without alignment: both start at the same pose, so drift shows.
/// @pre both have the same stamps
std::vector<double> positionErrors_m(const Trajectory& estimate, const Trajectory& truth);
/// Way to each pose along the path; 0 for the first. @pre not empty
std::vector<double> distancesAlong_m(const Trajectory& path);
ErrorSummary summarise(const std::vector<double>& errors_m);

/// RMSE after the estimate was moved and turned (never scaled) so that it is least. 0 for no poses.
/// By Eigen's umeyama. python/ has its own, in align.py: replay needs no Python for its summary,
/// and scripts/evaluate judges trajectories of any program without this build.
/// @pre both have the same stamps
double alignedRmse_m(const Trajectory& estimate, const Trajectory& truth);

/// Truth as odometry with this scale error would report it without any other error: positions
/// about the first one times (1 + scale_error).
Trajectory scaled(const Trajectory& truth, double scale_error);

/// KITTI odometry benchmark's translation error in percent: mean over sub-paths of 100, 200 .. 800
/// m that start at every 10th pose. @return nothing when the path is shorter than 100 m
std::optional<double> translationError_percent(const Trajectory& estimate, const Trajectory& truth);

/// Normalised estimation error squared of a position, expected 3.
double nees(const Eigen::Vector3d& error_m, const Eigen::Matrix3d& covariance);
/// What a true covariance exceeds as seldom as one coordinate exceeds 3 sigma: in 0.27 % of frames.
constexpr double kNees3Sigma = 14.156;

/// The value below which `share` of the values lie, interpolated; 0.5 is the median. 0 for none.
double quantile(std::vector<double> values, double share);

}  // namespace ardrone_vslam
