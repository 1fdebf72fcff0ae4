// SPDX-License-Identifier: BSD-3-Clause
#include "window/map_entry.hpp"

#include "ardrone_vslam/rotation.hpp"
#include "window/window_state.hpp"

namespace ardrone_vslam {

PoseByAnchor poseByAnchor(const Eigen::Vector3d& from_anchor) {
  PoseByAnchor J = PoseByAnchor::Identity();
  J.block<3, 3>(0, 3) = -skew(from_anchor);
  J.topRightCorner<3, 1>() = -from_anchor;
  return J;
}

void MapEntrance::move(const MapEntry& entry) {
  const Eigen::Matrix3d R = entry.T_loaded_flight.linear();
  state_.R_map_odom_ =
      R * state_.R_map_odom_ * R.transpose();  // of an odometry that is moved likewise
  state_.floor_map_m_ += entry.T_loaded_flight.translation().z();
  auto P = state_.covariance_.all();
  const auto move = [&](Clone& pose, int at) {
    pose.position_map = entry.T_loaded_flight * pose.position_map;
    pose.R_map_rig = R * pose.R_map_rig;
    for (const int rotated : {at, at + 3}) {
      P.middleRows<3>(rotated) = (R * P.middleRows<3>(rotated)).eval();
      P.middleCols<3>(rotated) = (P.middleCols<3>(rotated) * R.transpose()).eval();
    }
  };
  P.middleRows<3>(WindowState::kAttitude) = (R * P.middleRows<3>(WindowState::kAttitude)).eval();
  P.middleCols<3>(WindowState::kAttitude) =
      (P.middleCols<3>(WindowState::kAttitude) * R.transpose()).eval();
  for (std::size_t i = 0; i < state_.anchors_.size(); ++i)
    move(state_.anchors_[i], state_.anchorCoordinate(i));
  for (std::size_t i = 0; i < state_.frames_.size(); ++i)
    move(state_.frames_[i], state_.frameCoordinate(i));
}

void MapEntrance::share(const MapEntry& entry, std::size_t loaded) {
  auto P = state_.covariance_.all();
  // What the entry's errors move: all alike, but for the lever of the heading.
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(P.rows(), 4);
  const auto moves = [&](const Clone& pose, int at) {
    J.block<3, 3>(at, 0).setIdentity();
    J.block<3, 1>(at, 3) = Eigen::Vector3d::UnitZ().cross(pose.position_map - entry.camera_loaded);
    J(at + 5, 3) = 1;
  };
  J(WindowState::kAttitude + 2, 3) = 1;
  J(WindowState::kFloor, 2) = 1;
  for (std::size_t i = loaded; i < state_.anchors_.size(); ++i)
    moves(state_.anchors_[i], state_.anchorCoordinate(i));
  for (std::size_t i = 0; i < state_.frames_.size(); ++i)
    moves(state_.frames_[i], state_.frameCoordinate(i));
  // And what the anchor's errors move: the camera, as seen from its landmarks.
  const PoseByAnchor by_anchor =
      poseByAnchor(entry.camera_loaded - state_.anchors_[entry.anchor].position_map);
  Eigen::Matrix<double, 4, WindowState::kAnchor> M;
  M << by_anchor.topRows<3>(), by_anchor.row(5);
  const Eigen::MatrixXd MP =
      M * P.middleRows<WindowState::kAnchor>(state_.anchorCoordinate(entry.anchor));
  const Eigen::Matrix4d all =
      entry.covariance +
      MP.middleCols<WindowState::kAnchor>(state_.anchorCoordinate(entry.anchor)) * M.transpose();
  const Eigen::MatrixXd shared = J * MP;
  P += shared + shared.transpose();
  P += J * all * J.transpose();
}

void MapEntrance::enter(const MapEntry& entry, const LoadedAnchors& loaded) {
  move(entry);
  const auto count = static_cast<int>(loaded.anchors.size());
  state_.covariance_.insert(WindowState::kGlobals, WindowState::kAnchor * count);
  state_.covariance_.all().block(WindowState::kGlobals, WindowState::kGlobals,
                                 WindowState::kAnchor * count, WindowState::kAnchor * count) =
      loaded.covariance;
  state_.anchors_.insert(state_.anchors_.begin(), loaded.anchors.begin(), loaded.anchors.end());
  share(entry, loaded.anchors.size());
}

}  // namespace ardrone_vslam
