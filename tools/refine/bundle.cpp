// SPDX-License-Identifier: BSD-3-Clause
#include "refine/bundle.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ardrone_vslam/rotation.hpp"
#include "refine/bundle_covariance.hpp"
#include "refine/bundle_solver.hpp"
#include "refine/residuals.hpp"
#include "refine/view_weights.hpp"

namespace ardrone_vslam {
namespace {

// Of `track_common_px`: with a street's 3.5, which the filter needs, views would hardly count. How
// well the result is known follows from all of it, as with the best weights: rather too small.
constexpr double kMostCommon_px = 0.7;
// Of a distance's logarithm, among those that are compared: half or twice as far.
constexpr double kDistanceSigma = 0.7;

/// The losses belong to the bundle: views share them.
ceres::Problem::Options problemOptions() {
  ceres::Problem::Options options;
  options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.enable_fast_removal = true;
  return options;
}

}  // namespace

Bundle::Bundle(const FlightRecord& record)
    : record_(record),
      loss_(nullptr, ceres::TAKE_OWNERSHIP),
      problem_(problemOptions()),
      poses_(record.keyframes.size()),
      odometry_(record, poses_, problem_),
      points_(pointsOf(record)) {
  addViews();
}

void Bundle::addViews() {
  views_of_.resize(points_.size());
  for (std::size_t i = 0; i < points_.size(); ++i) {
    for (const Sight& sight : points_[i].sights) {
      const Keyframe& keyframe = record_.keyframes[sight.keyframe];
      View view;
      view.weight = std::make_unique<ceres::LossFunctionWrapper>(nullptr, ceres::TAKE_OWNERSHIP);
      view.residual = problem_.AddResidualBlock(
          costOf<ViewResidual, 2, 6, 3>({sight.root_base, sight.bearing_base,
                                         keyframe.T_base_cam.translation(), keyframe.T_map_base}),
          view.weight.get(), poses_[sight.keyframe].data(), points_[i].position_map.data());
      views_of_[i].push_back(std::move(view));
    }
    if (points_[i].distance_m > 0) addDistance(points_[i]);
  }
  weighViews(kMostCommon_px);
}

/// Compared with each other alone: they tell nothing of the scale.
void Bundle::addDistance(TrackPoint3d& point) {
  const std::size_t k = point.sights.front().keyframe;
  const Keyframe& keyframe = record_.keyframes[k];
  problem_.AddResidualBlock(
      costOf<DistanceResidual, 1, 6, 3, 1>({keyframe.T_map_base * keyframe.T_base_cam.translation(),
                                            point.distance_m, kDistanceSigma}),
      nullptr, poses_[k].data(), point.position_map.data(), &distances_grown_);
}

void Bundle::weighViews(double most_common_px) {
  const ViewWeights weights(record_, points_, most_common_px);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    for (std::size_t j = 0; j < views_of_[i].size(); ++j)
      views_of_[i][j].weight->Reset(new ceres::ScaledLoss(&loss_, weights.of(points_[i].sights[j]),
                                                          ceres::DO_NOT_TAKE_OWNERSHIP),
                                    ceres::TAKE_OWNERSHIP);
  }
}

std::vector<double*> Bundle::pointBlocks() {
  std::vector<double*> blocks;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (!views_of_[i].empty()) blocks.push_back(points_[i].position_map.data());
  }
  return blocks;
}

void Bundle::solve(double most_sigmas, const std::function<void()>& step) {
  loss_.Reset(new ceres::CauchyLoss(most_sigmas), ceres::TAKE_OWNERSHIP);
  solveBundle(problem_, pointBlocks(), poses_.size(), step);
}

void Bundle::drop(double most_sigmas) {
  for (std::size_t i = 0; i < points_.size(); ++i) {
    std::vector<Sight> sights;
    std::vector<View> views;
    const std::size_t before = views_of_[i].size();
    for (std::size_t j = 0; j < before; ++j) {
      Eigen::Vector2d off;
      View& view = views_of_[i][j];
      problem_.EvaluateResidualBlock(view.residual, false, nullptr, off.data(), nullptr);
      if (off.squaredNorm() < most_sigmas * most_sigmas) {
        sights.push_back(points_[i].sights[j]);
        views.push_back(std::move(view));
      } else {
        problem_.RemoveResidualBlock(view.residual);
      }
    }
    if (views.size() < points_[i].fewestViews()) {
      if (before > 0) problem_.RemoveParameterBlock(points_[i].position_map.data());
      sights.clear();
      views.clear();
    }
    dropped_ += before - views.size();
    points_[i].sights = std::move(sights);
    views_of_[i] = std::move(views);
  }
}

std::size_t Bundle::views() const {
  std::size_t count = 0;
  for (const std::vector<View>& views : views_of_) count += views.size();
  return count;
}

Eigen::Isometry3d Bundle::T_map_base(std::size_t keyframe) const {
  Eigen::Isometry3d T = record_.keyframes[keyframe].T_map_base;
  const double* error = poses_[keyframe].data();
  T.translation() += Eigen::Vector3d(error);
  T.linear() =
      rotationOf(Eigen::Vector3d(error + 3)) * T.linear() * R_base_rig(keyframe).transpose();
  return T;
}

Eigen::MatrixXd Bundle::covariance(const std::vector<std::size_t>& keyframes) {
  weighViews(record_.config.track_common_px);
  std::vector<double*> wanted{odometry_.scaleError()};
  for (const std::size_t k : keyframes) wanted.push_back(poses_[k].data());
  if (double* error = odometry_.extrinsicsError()) wanted.push_back(error);
  return covarianceOf(problem_, wanted, odometry_.chain(), pointBlocks());
}

std::vector<TrackPoint3d> Bundle::points() const {
  std::vector<TrackPoint3d> seen = points_;
  const auto isUnseen = [](const TrackPoint3d& point) { return point.sights.empty(); };
  seen.erase(std::remove_if(seen.begin(), seen.end(), isUnseen), seen.end());
  return seen;
}

}  // namespace ardrone_vslam
