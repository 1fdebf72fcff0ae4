// SPDX-License-Identifier: BSD-3-Clause
#include "maps/joint_maps.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>

#include "ardrone_vslam/rotation.hpp"
#include "maps/map_parts.hpp"

namespace ardrone_vslam {
namespace {

SavedMap moved(SavedMap map, const Eigen::Isometry3d& T) {
  const Eigen::Matrix3d R = T.linear();
  for (MapAnchor& anchor : map.anchors) anchor.T_map_rig = T * anchor.T_map_rig;
  auto& P = map.anchor_covariance;
  for (Eigen::Index at = 0; at < P.rows(); at += SavedMap::kAnchor) {
    for (const Eigen::Index part : {at, at + 3})
      P.middleRows<3>(part) = (R * P.middleRows<3>(part)).eval();
  }
  for (Eigen::Index at = 0; at < P.rows(); at += SavedMap::kAnchor) {
    for (const Eigen::Index part : {at, at + 3})
      P.middleCols<3>(part) = (P.middleCols<3>(part) * R.transpose()).eval();
  }
  for (Landmark& landmark : map.landmarks) {
    landmark.position_map = T * landmark.position_map;
    landmark.view_direction_map = R.cast<float>() * landmark.view_direction_map;
    landmark.covariance_m2 = R * landmark.covariance_m2.full() * R.transpose();
  }
  return map;
}

/// The largest variance of an anchor's position [m^2].
double most(const SavedMap& map) {
  double most_m2 = 0;
  for (Eigen::Index at = 0; at < map.anchor_covariance.rows(); at += SavedMap::kAnchor)
    most_m2 = std::max(most_m2, map.anchor_covariance.diagonal().segment<3>(at).maxCoeff());
  return most_m2;
}

}  // namespace

JointMaps::JointMaps(const SavedMap& a, const SavedMap& b, const MapAlignment& alignment)
    : before_a_(a),
      before_b_(moved(b, alignment.T_a_b)),
      a_(before_a_),
      b_(before_b_),
      of_a_(a.anchor_covariance.rows()),
      of_b_(b.anchor_covariance.rows()),
      P_(Eigen::MatrixXd::Zero(size(), size())) {
  for (const LandmarkPair& pair : alignment.agreed)
    middle_ += a.landmarks[pair.of_a].position_map / static_cast<double>(alignment.agreed.size());
  P_.topLeftCorner(of_a_, of_a_) = a_.anchor_covariance;
  P_.block(of_a_, of_a_, of_b_, of_b_) = b_.anchor_covariance;
  // Nothing is known of the move but what the pairs tell: wide beside what the maps may err.
  const double drift_m2 = std::max(most(a_), most(b_));
  P_.bottomRightCorner<kMove, kMove>().diagonal() << Eigen::Vector3d::Constant(1 + 100 * drift_m2),
      1;
}

void JointMaps::correctBy(const std::vector<LandmarkPair>& pairs) {
  constexpr int kSteps = 8;
  const Eigen::MatrixXd I = Eigen::MatrixXd::Identity(size(), size());
  Eigen::VectorXd errors = Eigen::VectorXd::Zero(size());
  Eigen::MatrixXd gain;
  Sums sums;
  for (int step = 0; step < kSteps; ++step) {
    sums = sumsOf(pairs, step > 0);
    // (P^-1 + information)^-1 of a P that may be singular: a map's first anchor errs by nothing.
    gain = (I + P_ * sums.information).partialPivLu().solve(P_);
    errors = gain * (sums.vector + sums.information * errors);
    move_ = errors.tail<kMove>();
    a_ = corrected(before_a_, errors.head(of_a_), Eigen::Vector4d::Zero());
    b_ = corrected(before_b_, errors.segment(of_a_, of_b_), move_);
  }
  const Eigen::MatrixXd rest = I - gain * sums.information;
  // In this form (Joseph's) it stays positive.
  P_ = rest * P_ * rest.transpose() + gain * sums.information * gain.transpose();
}

Eigen::MatrixXd JointMaps::anchorCovariance() const {
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(of_a_ + of_b_, size());
  M.leftCols(of_a_ + of_b_).setIdentity();
  for (std::size_t i = 0; i < b_.anchors.size(); ++i) {
    const Eigen::Index at = of_a_ + coordinateOf(i);
    for (const Eigen::Index part : {at, at + 3})
      M.block<3, 3>(part, part) = rotationAboutZ(move_(3));
    M.block<3, kMove>(at, of_a_ + of_b_) = byMove(b_.anchors[i].T_map_rig.translation());
    M(at + 5, size() - 1) = 1;
  }
  const Eigen::MatrixXd P = M * P_ * M.transpose();
  return 0.5 * (P + P.transpose());
}

Eigen::Vector3d JointMaps::offset(const LandmarkPair& pair) const {
  return a_.landmarks[pair.of_a].position_map - b_.landmarks[pair.of_b].position_map;
}

/// Of an offset that anchors and move do not explain.
Eigen::Matrix3d JointMaps::covarianceOf(const LandmarkPair& pair) const {
  return a_.landmarks[pair.of_a].covariance_m2.full() +
         b_.landmarks[pair.of_b].covariance_m2.full() +
         kOtherView_m * kOtherView_m * Eigen::Matrix3d::Identity();
}

double JointMaps::distance(const LandmarkPair& pair) const {
  return offset(pair).dot(covarianceOf(pair).inverse() * offset(pair));
}

/// @param position  of b, moved
Eigen::Matrix<double, 3, JointMaps::kMove> JointMaps::byMove(
    const Eigen::Vector3d& position) const {
  Eigen::Matrix<double, 3, kMove> J;
  const Eigen::Vector3d lever = position - middle_ - move_.head<3>();
  J << Eigen::Matrix3d::Identity(), Eigen::Vector3d::UnitZ().cross(lever);
  return J;
}

/// Where both maps together see a pair's landmark. Derivatives are taken there: from where each
/// of them sees it, noise would make both maps smaller.
Eigen::Vector3d JointMaps::positionOf(const LandmarkPair& pair) const {
  const Landmark& in_a = a_.landmarks[pair.of_a];
  return in_a.position_map -
         in_a.covariance_m2.full() * covarianceOf(pair).inverse() * offset(pair);
}

/// Of b's anchors, whose errors are turned with the map.
Eigen::Matrix<double, 3, JointMaps::kAnchor> JointMaps::byTurnedAnchor(
    const MapAnchor& anchor, const Eigen::Vector3d& position) const {
  Eigen::Matrix<double, 3, kAnchor> J = byAnchor(anchor, position);
  const Eigen::Matrix3d turn = rotationAboutZ(move_(3));
  J.leftCols<3>() = (J.leftCols<3>() * turn).eval();
  J.middleCols<3>(3) = (J.middleCols<3>(3) * turn).eval();
  return J;
}

JointMaps::Sums JointMaps::sumsOf(const std::vector<LandmarkPair>& pairs, bool are_weighted) const {
  constexpr Eigen::Index kOfPair = 2 * kAnchor + kMove;
  Sums sums{Eigen::MatrixXd::Zero(size(), size()), Eigen::VectorXd::Zero(size())};
  for (const LandmarkPair& pair : pairs) {
    const Landmark& in_a = a_.landmarks[pair.of_a];
    const Landmark& in_b = b_.landmarks[pair.of_b];
    Eigen::Matrix<double, 3, kOfPair> H;
    const Eigen::Vector3d position = positionOf(pair);
    H << -byAnchor(a_.anchors[in_a.anchor_id - 1], position),
        byTurnedAnchor(b_.anchors[in_b.anchor_id - 1], position), byMove(position);
    const double weight = are_weighted ? 1 / (1 + distance(pair) / kOne) : 1;  // Cauchy's
    const Eigen::Matrix<double, kOfPair, 3> HtW =
        weight * H.transpose() * covarianceOf(pair).inverse();
    const Eigen::Matrix<double, kOfPair, kOfPair> HtWH = HtW * H;
    const Eigen::Matrix<double, kOfPair, 1> HtWr = HtW * offset(pair);
    const std::array<std::array<Eigen::Index, 3>, 3> parts = {
        {{coordinateOf(in_a.anchor_id - 1), 0, kAnchor},
         {of_a_ + coordinateOf(in_b.anchor_id - 1), kAnchor, kAnchor},
         {of_a_ + of_b_, 2 * kAnchor, kMove}}};
    for (const auto& [to, from, rows] : parts) {
      sums.vector.segment(to, rows) += HtWr.segment(from, rows);
      for (const auto& [to_col, from_col, cols] : parts)
        sums.information.block(to, to_col, rows, cols) += HtWH.block(from, from_col, rows, cols);
    }
  }
  return sums;
}

/// @param before  the map; @param errors  of its anchors; @param move  of all of it
SavedMap JointMaps::corrected(const SavedMap& before, const Eigen::VectorXd& errors,
                              const Eigen::Vector4d& move) const {
  SavedMap map = before;
  const Eigen::Matrix3d turn = rotationAboutZ(move(3));
  const auto goesTo = [&](const Eigen::Vector3d& position) -> Eigen::Vector3d {
    return middle_ + turn * (position - middle_) + move.head<3>();
  };
  const auto turnOf = [&](std::size_t anchor) -> Eigen::Matrix3d {
    return turn * rotationOf(errors.segment<3>(coordinateOf(anchor) + 3));
  };
  for (Landmark& landmark : map.landmarks) {
    const std::size_t anchor = landmark.anchor_id - 1;
    landmark.position_map =
        goesTo(landmark.position_map + byAnchor(map.anchors[anchor], landmark.position_map) *
                                           errors.segment<kAnchor>(coordinateOf(anchor)));
    const Eigen::Matrix3d R = turnOf(anchor);
    const double stretch = 1 - errors(coordinateOf(anchor) + kAnchor - 1);
    landmark.view_direction_map = R.cast<float>() * landmark.view_direction_map;
    landmark.covariance_m2 = stretch * stretch * R * landmark.covariance_m2.full() * R.transpose();
  }
  for (std::size_t i = 0; i < map.anchors.size(); ++i) {
    Eigen::Isometry3d& T = map.anchors[i].T_map_rig;
    T.translation() = goesTo(T.translation() + errors.segment<3>(coordinateOf(i)));
    T.linear() = turnOf(i) * T.linear();
  }
  return map;
}

}  // namespace ardrone_vslam
