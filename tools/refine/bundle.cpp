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

// Of a sigma [m, m/s, rad]: as good as exact; with less the equations are worse than double is.
constexpr double kLeast = 1e-5;
// Of `track_common_px`: with a street's 3.5, which the filter needs, views would hardly count. How
// well the result is known follows from all of it, as with the best weights: rather too small.
constexpr double kMostCommon_px = 0.7;

double squared(double value) {
  return value * value;
}

double radians(double degrees) {
  return degrees * M_PI / 180;
}

/// The losses belong to the bundle: views share them.
ceres::Problem::Options problemOptions() {
  ceres::Problem::Options options;
  options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.enable_fast_removal = true;
  return options;
}

ceres::CostFunction* priorOf(const Eigen::Vector3d& sigma) {
  return costOf<PriorResidual<3>, 3, 3>({sigma});
}

ceres::CostFunction* slowErrorOf(const Eigen::Vector3d& keep, const Eigen::Vector3d& sigma) {
  return costOf<SlowErrorResidual, 3, 3, 3>({keep, sigma.cwiseMax(kLeast)});
}

}  // namespace

Bundle::Bundle(const FlightRecord& record)
    : record_(record),
      loss_(nullptr, ceres::TAKE_OWNERSHIP),
      problem_(problemOptions()),
      poses_(record.keyframes.size()),
      biases_(record.keyframes.size()),
      attitudes_(record.keyframes.size()),
      points_(pointsOf(record)) {
  addOdometry();
  addHeights();
  addViews();
}

void Bundle::add(ceres::CostFunction* cost, std::initializer_list<double*> of) {
  problem_.AddResidualBlock(cost, nullptr, std::vector<double*>(of));
}

void Bundle::addOdometry() {
  const OdometryNoiseConfig& noise = record_.config.odometry;
  const double tilt_rad = radians(noise.tilt_sigma_deg);
  // Where the first keyframe is, map begins; yaw is zero by definition.
  add(priorOf(Eigen::Vector3d(tilt_rad, tilt_rad, 0).cwiseMax(kLeast)), {attitudes_[0].data()});
  add(priorOf(Eigen::Vector3d::Constant(std::max(noise.velocity_bias_m_s, kLeast))),
      {biases_[0].data()});
  add(costOf<PriorResidual<1>, 1, 1>({Eigen::Matrix<double, 1, 1>(noise.scale_sigma)}),
      {&scale_error_});
  add(costOf<StartResidual, 3, 6>({kLeast}), {poses_[0].data()});
  const double attitude_noise_rad = radians(noise.attitude_noise_deg);
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    const Keyframe& keyframe = record_.keyframes[i];
    add(costOf<AttitudeResidual, 3, 6, 3>(
            {keyframe.T_map_base.linear() * keyframe.T_odom_base.linear().transpose(),
             attitude_noise_rad}),
        {poses_[i].data(), attitudes_[i].data()});
    if (i > 0) addStep(i);
  }
}

void Bundle::addStep(std::size_t to) {
  const OdometryNoiseConfig& noise = record_.config.odometry;
  const Keyframe& before = record_.keyframes[to - 1];
  const Keyframe& after = record_.keyframes[to];
  const double dt_s = 1e-9 * static_cast<double>(after.stamp_ns - before.stamp_ns);
  const auto grown = [dt_s](double time_s) { return std::sqrt(1 - std::exp(-2 * dt_s / time_s)); };

  const double keep_tilt = std::exp(-dt_s / noise.tilt_time_s);
  const double tilt_rad = radians(noise.tilt_sigma_deg) * grown(noise.tilt_time_s);
  const double yaw_rad = std::sqrt(squared(radians(noise.yaw_walk_deg_per_sqrt_s)) * dt_s +
                                   squared(radians(noise.yaw_walk_deg_per_sqrt_m)) * after.way_m);
  add(slowErrorOf({keep_tilt, keep_tilt, 1}, {tilt_rad, tilt_rad, yaw_rad}),
      {attitudes_[to - 1].data(), attitudes_[to].data()});

  const double time_s = noise.velocity_bias_time_s;
  const double bias_m_s = noise.velocity_bias_m_s;
  add(slowErrorOf(Eigen::Vector3d::Constant(std::exp(-dt_s / time_s)),
                  Eigen::Vector3d::Constant(bias_m_s * grown(time_s))),
      {biases_[to - 1].data(), biases_[to].data()});

  // The bias changes on the way, too: for a short one, and for one of many time constants.
  const double by_bias_m2 =
      squared(bias_m_s) * std::min(2 * dt_s * dt_s * dt_s / (3 * time_s), 2 * time_s * dt_s);
  WayResidual way;
  way.from_map = before.T_map_base.translation();
  way.to_map = after.T_map_base.translation();
  way.way_odom_m = after.T_odom_base.translation() - before.T_odom_base.translation();
  way.R_odom_base = before.T_odom_base.linear();
  way.duration_s = time_s * (1 - std::exp(-dt_s / time_s));  // of a bias that fades
  way.sigma_m = std::max(std::sqrt(after.way_variance_m2 + by_bias_m2), kLeast);
  add(costOf<WayResidual, 3, 6, 6, 3, 3, 1>(way),
      {poses_[to - 1].data(), poses_[to].data(), attitudes_[to - 1].data(), biases_[to - 1].data(),
       &scale_error_});
}

void Bundle::addHeights() {
  floors_map_m_.assign(static_cast<std::size_t>(record_.keyframes.back().floor) + 1, 0.0);
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    const Keyframe& keyframe = record_.keyframes[i];
    if (!keyframe.height_m) continue;
    add(costOf<HeightResidual, 1, 6, 1>({*keyframe.height_m, keyframe.T_map_base.translation().z(),
                                         record_.config.height.height_sigma_m}),
        {poses_[i].data(), &floors_map_m_[static_cast<std::size_t>(keyframe.floor)]});
  }
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
  }
  weighViews(kMostCommon_px);
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
      if (off.squaredNorm() < squared(most_sigmas)) {
        sights.push_back(points_[i].sights[j]);
        views.push_back(std::move(view));
      } else {
        problem_.RemoveResidualBlock(view.residual);
      }
    }
    if (views.size() < kFewestViews) {
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
  T.linear() = rotationOf(Eigen::Vector3d(error + 3)) * T.linear();
  return T;
}

Eigen::MatrixXd Bundle::covariance(const std::vector<std::size_t>& keyframes) {
  weighViews(record_.config.track_common_px);
  std::vector<double*> wanted{&scale_error_};
  for (const std::size_t k : keyframes) wanted.push_back(poses_[k].data());
  std::vector<double*> chain;
  for (auto* errors : {&attitudes_, &biases_}) {
    for (Vector& error : *errors) chain.push_back(error.data());
  }
  return covarianceOf(problem_, wanted, chain, pointBlocks());
}

std::vector<TrackPoint3d> Bundle::points() const {
  std::vector<TrackPoint3d> seen = points_;
  const auto isUnseen = [](const TrackPoint3d& point) { return point.sights.empty(); };
  seen.erase(std::remove_if(seen.begin(), seen.end(), isUnseen), seen.end());
  return seen;
}

}  // namespace ardrone_vslam
