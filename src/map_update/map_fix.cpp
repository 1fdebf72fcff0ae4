// SPDX-License-Identifier: BSD-3-Clause
#include "map_update/map_fix.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "ardrone_vslam/rotation.hpp"
#include "linear/median.hpp"
#include "linear/selection.hpp"
#include "map_update/observation_rays.hpp"
#include "window/rays.hpp"

namespace ardrone_vslam {
namespace {

// Pairs of matches: with half of them wrong none is right once in 100,000.
constexpr int kSamples = 40;
constexpr double kRotation_rad = 0.02;    // keeps the turn of a fix by few landmarks regular
constexpr double kNoRotation_rad = 1e-6;  // where the attitude is taken as exact

/// Coordinates of a fix: scale, newest pose, anchors (each once, ascending).
struct FixCoordinates {
  std::vector<std::size_t> anchors;
  std::vector<int> all;

  FixCoordinates(const WindowState& state, const std::vector<MapObservation>& observations) {
    anchors.reserve(observations.size());
    for (const MapObservation& observation : observations) anchors.push_back(observation.anchor);
    std::sort(anchors.begin(), anchors.end());
    anchors.erase(std::unique(anchors.begin(), anchors.end()), anchors.end());
    all.reserve(1 + WindowState::kFrame + WindowState::kAnchor * anchors.size());
    all.push_back(WindowState::kScale);
    const int newest = state.frameCoordinate(state.frames().size() - 1);
    for (int k = 0; k < WindowState::kFrame; ++k) all.push_back(newest + k);
    for (const std::size_t anchor : anchors) {
      for (int k = 0; k < WindowState::kAnchor; ++k)
        all.push_back(state.anchorCoordinate(anchor) + k);
    }
  }

  /// Where scale, pose and one anchor stand among all.
  std::array<int, 14> of(std::size_t anchor) const {
    const auto at = std::lower_bound(anchors.begin(), anchors.end(), anchor) - anchors.begin();
    std::array<int, 14> places{};
    for (int k = 0; k < 7; ++k) places[static_cast<std::size_t>(k)] = k;
    for (int k = 0; k < 7; ++k)
      places[7U + static_cast<std::size_t>(k)] = 7 + 7 * static_cast<int>(at) + k;
    return places;
  }
};

}  // namespace

ObservationConsensus agreeOnPosition(const Clone& predicted, const Eigen::Vector3d& camera_rig,
                                     const std::vector<MapObservation>& observations,
                                     double angle_sigma_rad) {
  const Eigen::Vector3d lever = predicted.R_map_rig * camera_rig;
  std::vector<Eigen::Vector3d> rays;
  rays.reserve(observations.size());
  for (const MapObservation& s : observations) rays.push_back(predicted.R_map_rig * s.bearing_rig);
  const auto off = [&](std::size_t i, const Eigen::Vector3d& camera) {
    return offRay(observations[i], rays[i], camera, angle_sigma_rad, kSlack_rad);
  };
  const auto scoreOf = [&](const Eigen::Vector3d& camera) {
    double score = 0;
    for (std::size_t i = 0; i < observations.size(); ++i)
      score += std::max(0.0, 1 - off(i, camera) / kInlier);
    return score;
  };

  Eigen::Vector3d best = predicted.position_map + lever;
  double best_score = scoreOf(best);
  Draws draws;
  for (int k = 0; k < kSamples && observations.size() >= 2; ++k) {
    const std::size_t a = draws.below(observations.size());
    const std::size_t b = draws.below(observations.size());
    if (a == b) continue;
    const Eigen::Vector3d camera =
        nearestToRays(observations[a], rays[a], observations[b], rays[b]);
    if (!camera.allFinite()) continue;
    const double score = scoreOf(camera);
    if (score <= best_score) continue;
    best_score = score;
    best = camera;
  }
  ObservationConsensus consensus;
  consensus.position_map = best - lever;
  consensus.R_map_rig = predicted.R_map_rig;
  consensus.observations.reserve(observations.size());
  for (std::size_t i = 0; i < observations.size(); ++i) {
    if (off(i, best) < kInlier) consensus.observations.push_back(observations[i]);
  }
  return consensus;
}

Vector6d MapFix::whitened() const {
  return Matrix6d(drift + covariance).llt().matrixL().solve(offset);
}

double MapFix::distance() const {
  return whitened().squaredNorm();
}

MapFix fixBy(const WindowState& state, const Eigen::Vector3d& camera_rig,
             const ObservationConsensus& consensus, double angle_sigma_rad, int independent) {
  const FixCoordinates coordinates(state, consensus.observations);
  MapFix fix{Information(coordinates.all)};
  // Jacobians at the agreed pose: the prediction may be far off.
  Clone pose = state.frames().back();
  Vector6d moved = Vector6d::Zero();
  moved.head<3>() = consensus.position_map - pose.position_map;
  moved.tail<3>() = rotationVectorOf(consensus.R_map_rig * pose.R_map_rig.transpose());
  pose.position_map = consensus.position_map;
  pose.R_map_rig = consensus.R_map_rig;
  for (const MapObservation& s : consensus.observations) {
    const auto ray = rayResidual(pose, camera_rig, s.bearing_rig, s.point_map);
    if (!ray) continue;
    const Clone& anchor = state.anchors()[s.anchor];
    const Eigen::Vector3d from_anchor = s.point_map - anchor.position_map;
    Eigen::Matrix<double, 2, 14> H;
    // The covariance's dilation is that of the predicted position: seen from the agreed one, the
    // fix would seem to tell the scale.
    // What is loaded has been scaled by another flight.
    if (anchor.is_loaded) {
      H.col(0).setZero();
    } else {
      H.col(0) = -ray->point * (from_anchor - moved.head<3>());
    }
    H.middleCols<6>(1) = ray->pose;
    H.middleCols<3>(7) = ray->point;
    H.middleCols<3>(10) = -ray->point * skew(from_anchor);
    H.col(13) = -ray->point * from_anchor;
    const Eigen::Matrix2d noise = angle_sigma_rad * angle_sigma_rad * Eigen::Matrix2d::Identity() +
                                  ray->point * s.covariance_m2 * ray->point.transpose();
    const Eigen::Matrix<double, 14, 2> weighted = H.transpose() * noise.inverse();
    fix.information.add<14>(coordinates.of(s.anchor), weighted * H,
                            weighted * (ray->residual + ray->pose * moved));
  }
  const double share =
      std::min(1.0, static_cast<double>(independent) /
                        std::max(1.0, static_cast<double>(consensus.observations.size())));
  fix.information.matrix *= share;
  fix.information.vector *= share;

  Matrix6d on_pose = fix.information.matrix.block<6, 6>(1, 1);
  const int attitude = state.frameCoordinate(state.frames().size() - 1) + 3;
  const bool is_exact = state.covariance().diagonal().segment<3>(attitude).isZero(0);
  const double rotation_rad = is_exact ? kNoRotation_rad : kRotation_rad;
  on_pose.diagonal().tail<3>().array() += 1 / (rotation_rad * rotation_rad);
  fix.covariance = on_pose.inverse();
  const Eigen::MatrixXd J = fix.covariance * fix.information.matrix.middleRows<6>(1);
  fix.offset = fix.covariance * fix.information.vector.segment<6>(1);
  const Eigen::MatrixXd P = rowsOf(colsOf(state.covariance(), coordinates.all), coordinates.all);
  fix.drift = J * P * J.transpose();
  return fix;
}

double attitudeSigma_rad(const std::vector<MapObservation>& observations,
                         const WindowState& state) {
  const int newest = state.frameCoordinate(state.frames().size() - 1);
  std::vector<bool> is_seen(state.anchors().size(), false);
  for (const MapObservation& s : observations) is_seen[s.anchor] = true;
  double variance_rad2 = 0;
  for (std::size_t i = 0; i < is_seen.size(); ++i) {
    if (!is_seen[i]) continue;
    const Matrix6d relative = state.relativeCovariance(newest, state.anchorCoordinate(i));
    variance_rad2 = std::max(variance_rad2, relative.bottomRightCorner<3, 3>().trace() / 3);
  }
  return std::sqrt(variance_rad2);
}

double medianWindow_rad(const std::vector<MapObservation>& observations) {
  std::vector<double> windows_rad;
  windows_rad.reserve(observations.size());
  for (const MapObservation& s : observations) windows_rad.push_back(s.window_rad);
  return medianOf(windows_rad);
}

}  // namespace ardrone_vslam
