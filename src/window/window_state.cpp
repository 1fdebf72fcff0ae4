// SPDX-License-Identifier: BSD-3-Clause
#include "window/window_state.hpp"

#include "ardrone_vslam/rotation.hpp"

namespace ardrone_vslam {

void WindowState::holdNewest(std::size_t reference, const Eigen::Vector3d& camera_rig,
                             const Eigen::Matrix3d& sigma_m2) {
  const Clone& then = frames_[reference];
  Clone& newest = frames_.back();
  const Eigen::Vector3d lever_then = then.R_map_rig * camera_rig;
  const Eigen::Vector3d lever = newest.R_map_rig * camera_rig;
  newest.position_map = then.position_map + lever_then - lever;
  const int from = frameCoordinate(reference);
  const int to = frameCoordinate(frames_.size() - 1);
  auto P = covariance_.all();
  P.middleRows<3>(to) = (P.middleRows<3>(from) - skew(lever_then) * P.middleRows<3>(from + 3) +
                         skew(lever) * P.middleRows<3>(to + 3))
                            .eval();
  P.middleCols<3>(to) =
      (P.middleCols<3>(from) - P.middleCols<3>(from + 3) * skew(lever_then).transpose() +
       P.middleCols<3>(to + 3) * skew(lever).transpose())
          .eval();
  P.block<3, 3>(to, to) += sigma_m2;
}

void WindowState::beginFloor(double height_m, double variance_m2) {
  floor_map_m_ = frames_.back().position_map.z() - height_m;
  covariance_.copy(frameCoordinate(frames_.size() - 1) + 2, kFloor, 1);
  covariance_.all()(kFloor, kFloor) += variance_m2;
}

void WindowState::beginExtrinsics(double variance_rad2) {
  R_base_rig_.setIdentity();
  covariance_.clear(kExtrinsics, 3);
  covariance_.all().diagonal().segment<3>(kExtrinsics).setConstant(variance_rad2);
}

void WindowState::removeFrame(std::size_t frame) {
  covariance_.remove(frameCoordinate(frame), kFrame);
  frames_.erase(frames_.begin() + static_cast<std::ptrdiff_t>(frame));
}

void WindowState::makeAnchor(std::size_t frame) {
  const int anchor = anchorCoordinate(anchors_.size());
  covariance_.insert(anchor, kAnchor);
  covariance_.copy(frameCoordinate(frame) + kAnchor, anchor, kFrame);
  auto P = covariance_.all();
  const int stretch = anchor + kFrame;
  const Eigen::Vector3d& by_bias_s_m = frames_[frame].stretch_by_bias_s_m;
  P.col(stretch) = P.middleCols<3>(kBias) * by_bias_s_m;
  P(stretch, stretch) = by_bias_s_m.dot(P.block<3, 1>(kBias, stretch));
  P.row(stretch) = P.col(stretch).transpose();
  anchors_.push_back(frames_[frame]);
  removeFrame(frame);
}

void WindowState::removeAnchor(std::size_t anchor) {
  covariance_.remove(anchorCoordinate(anchor), kAnchor);
  anchors_.erase(anchors_.begin() + static_cast<std::ptrdiff_t>(anchor));
}

Eigen::Isometry3d WindowState::T_map_base() const {
  const Eigen::Isometry3d at_base(Eigen::Translation3d(newest().position_map));
  return at_base * Eigen::Isometry3d(newest().R_map_rig * R_base_rig_.transpose());
}

Matrix6d WindowState::baseCovariance() const {
  const auto P = covariance();
  const int at = frameCoordinate(frames_.size() - 1);
  const Eigen::Matrix3d R_map_base = T_map_base().linear();
  const Eigen::Matrix<double, 6, 3> shared =
      P.block<6, 3>(at, kExtrinsics) * R_map_base.transpose();
  Matrix6d covariance = P.block<6, 6>(at, at);
  covariance.rightCols<3>() -= shared;
  covariance.bottomRows<3>() -= shared.transpose();
  covariance.bottomRightCorner<3, 3>() +=
      R_map_base * P.block<3, 3>(kExtrinsics, kExtrinsics) * R_map_base.transpose();
  return 0.5 * (covariance + covariance.transpose());  // to the bit, whatever rounding did
}

}  // namespace ardrone_vslam
