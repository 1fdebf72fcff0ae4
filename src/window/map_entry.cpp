// SPDX-License-Identifier: BSD-3-Clause
#include "window/map_entry.hpp"

#include <algorithm>
#include <cassert>

#include "ardrone_vslam/rotation.hpp"
#include "linear/scalars.hpp"
#include "window/window_state.hpp"

namespace ardrone_vslam {

PoseByAnchor poseByAnchor(const Eigen::Vector3d& from_anchor) {
  PoseByAnchor J = PoseByAnchor::Identity();
  J.block<3, 3>(0, 3) = -skew(from_anchor);
  J.topRightCorner<3, 1>() = -from_anchor;
  return J;
}

double Revisit::shareOf(const Clone& pose) const {
  if (pose.is_loaded || pose.stamp_ns < from_ns) return 0;
  if (pose.stamp_ns >= to_ns) return 1;
  return static_cast<double>(pose.stamp_ns - from_ns) / static_cast<double>(to_ns - from_ns);
}

void MapEntrance::move(const Revisit& revisit) {
  const Eigen::Isometry3d& T = revisit.entry.T_loaded_flight;
  const Eigen::Vector3d turn_rad = rotationVectorOf(T.linear());
  auto P = state_.covariance_.all();
  const auto turn = [&P](const Eigen::Matrix3d& R, int at) {
    P.middleRows<3>(at) = (R * P.middleRows<3>(at)).eval();
    P.middleCols<3>(at) = (P.middleCols<3>(at) * R.transpose()).eval();
  };
  const auto move = [&](Clone& pose, int at) {
    const double share = revisit.shareOf(pose);
    if (share == 0) return;
    const Eigen::Matrix3d R = rotationOf(share * turn_rad);
    pose.position_map += share * (T * pose.position_map - pose.position_map);
    pose.R_map_rig = R * pose.R_map_rig;
    turn(R, at);
    turn(R, at + 3);
  };
  state_.floor_map_m_ += T.translation().z();
  // Of an odometry that is moved likewise.
  state_.R_map_odom_ = T.linear() * state_.R_map_odom_ * T.linear().transpose();
  turn(T.linear(), WindowState::kAttitude);
  for (std::size_t i = 0; i < state_.anchors_.size(); ++i)
    move(state_.anchors_[i], state_.anchorCoordinate(i));
  for (std::size_t i = 0; i < state_.frames_.size(); ++i)
    move(state_.frames_[i], state_.frameCoordinate(i));
}

Eigen::MatrixXd MapEntrance::cameraBy(std::uint32_t id, const MapEntry& entry) const {
  const auto anchor = indexOf(state_.anchors_, id);
  const auto frame = indexOf(state_.frames_, id);
  assert((anchor || frame) && "a place is told by a pose of the state");
  const Clone& pose = anchor ? state_.anchors_[*anchor] : state_.frames_[*frame];
  const PoseByAnchor by_pose = poseByAnchor(entry.camera_loaded - pose.position_map);
  Eigen::MatrixXd D = Eigen::MatrixXd::Zero(4, state_.covariance().rows());
  const int at = anchor ? state_.anchorCoordinate(*anchor) : state_.frameCoordinate(*frame);
  const int count = anchor ? WindowState::kAnchor : WindowState::kFrame;
  D.block(0, at, 3, count) = by_pose.topLeftCorner(3, count);
  D.block(3, at, 1, count) = by_pose.block(5, 0, 1, count);
  // With the odometry's scale all distances of this flight err.
  if (!pose.is_loaded) D.block<3, 1>(0, WindowState::kScale) = by_pose.topRightCorner<3, 1>();
  return D;
}

// D: what the camera's position and heading err by from now on beside what they erred by before, of
// all coordinates; and beside that there is what the entry errs by.
void MapEntrance::share(const Revisit& revisit, const Eigen::MatrixXd& D) {
  auto P = state_.covariance_.all();
  // What that moves: all alike, but for the lever of the heading.
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(P.rows(), 4);
  const auto moves = [&](const Clone& pose, int at) {
    const double share = revisit.shareOf(pose);
    J.block<3, 3>(at, 0) = share * Eigen::Matrix3d::Identity();
    J.block<3, 1>(at, 3) =
        share * Eigen::Vector3d::UnitZ().cross(pose.position_map - revisit.entry.camera_loaded);
    J(at + 5, 3) = share;
  };
  J(WindowState::kAttitude + 2, 3) = 1;
  J(WindowState::kFloor, 2) = 1;
  for (std::size_t i = 0; i < state_.anchors_.size(); ++i)
    moves(state_.anchors_[i], state_.anchorCoordinate(i));
  for (std::size_t i = 0; i < state_.frames_.size(); ++i)
    moves(state_.frames_[i], state_.frameCoordinate(i));
  const Eigen::MatrixXd DP = D * P;
  const Eigen::Matrix4d all = revisit.entry.covariance + DP * D.transpose();
  const Eigen::MatrixXd shared = J * DP;
  P += shared + shared.transpose();
  P += J * all * J.transpose();
}

void MapEntrance::enter(const MapEntry& entry, const LoadedAnchors& loaded) {
  Revisit revisit;
  revisit.entry = entry;
  move(revisit);
  const auto count = static_cast<int>(loaded.anchors.size());
  state_.covariance_.insert(WindowState::kGlobals, WindowState::kAnchor * count);
  state_.covariance_.all().block(WindowState::kGlobals, WindowState::kGlobals,
                                 WindowState::kAnchor * count, WindowState::kAnchor * count) =
      loaded.covariance;
  state_.anchors_.insert(state_.anchors_.begin(), loaded.anchors.begin(), loaded.anchors.end());
  share(revisit, cameraBy(loaded.anchors[entry.anchor].id, entry));
}

// Between the two times nobody knows when the error grew. So what lies between errs as a random
// walk does whose end is known (a Brownian bridge), and whose size is that of the correction.
void MapEntrance::loosen(const Revisit& revisit) {
  struct Between {
    int coordinate;
    double share;
  };
  std::vector<Between> poses;
  double extent_m = 0;
  const auto note = [&](const Clone& pose, int at) {
    const double share = revisit.shareOf(pose);
    if (share > 0 && share < 1) poses.push_back({at, share});
    if (share > 0)
      extent_m = std::max(extent_m, (pose.position_map - state_.newest().position_map).norm());
  };
  for (std::size_t i = 0; i < state_.anchors_.size(); ++i)
    note(state_.anchors_[i], state_.anchorCoordinate(i));
  for (std::size_t i = 0; i < state_.frames_.size(); ++i)
    note(state_.frames_[i], state_.frameCoordinate(i));
  const Eigen::Isometry3d& T = revisit.entry.T_loaded_flight;
  const double turn_rad2 = squared(angleOf_rad(T.linear()));
  const Eigen::Vector3d way_m = T * state_.newest().position_map - state_.newest().position_map;
  const double way_m2 = way_m.squaredNorm() + turn_rad2 * squared(extent_m);
  auto P = state_.covariance_.all();
  for (const Between& a : poses) {
    for (const Between& b : poses) {
      const double bridge = std::min(a.share, b.share) * (1 - std::max(a.share, b.share));
      P.block<3, 3>(a.coordinate, b.coordinate).diagonal().array() += bridge * way_m2;
      P(a.coordinate + 5, b.coordinate + 5) += bridge * turn_rad2;
    }
  }
}

void MapEntrance::shift(const Revisit& revisit) {
  loosen(revisit);
  move(revisit);
  share(revisit,
        cameraBy(revisit.anchor_id, revisit.entry) - cameraBy(state_.newest().id, revisit.entry));
}

void MapEntrance::doubtSince(std::int64_t since_ns, const Matrix6d& covariance) {
  // By the newest pose's error: rows of the coordinates that it moves.
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(state_.covariance().rows(), 6);
  J.block<3, 3>(WindowState::kAttitude, 3).setIdentity();
  const auto moves = [&](const Clone& pose, int coordinate) {
    if (pose.is_loaded || pose.stamp_ns < since_ns) return;
    J.block<6, 6>(coordinate, 0).setIdentity();
    J.block<3, 3>(coordinate, 3) = -skew(pose.position_map - state_.newest().position_map);
  };
  for (std::size_t i = 0; i < state_.anchors().size(); ++i)
    moves(state_.anchors()[i], state_.anchorCoordinate(i));
  for (std::size_t i = 0; i < state_.frames().size(); ++i)
    moves(state_.frames()[i], state_.frameCoordinate(i));
  state_.covariance_.all() += J * covariance * J.transpose();
}

}  // namespace ardrone_vslam
