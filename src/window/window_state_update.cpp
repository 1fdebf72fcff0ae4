// SPDX-License-Identifier: BSD-3-Clause
// What measurements do to the window's mean and covariance.
#include <Eigen/LU>

#include "ardrone_vslam/rotation.hpp"
#include "linear/selection.hpp"
#include "window/common_drift.hpp"
#include "window/correction.hpp"
#include "window/window_state.hpp"

namespace ardrone_vslam {

// Of (P^-1 + H' W H) e = H' W r, times P, which may be singular. Nobody asks for the covariance,
// and so the information need not be taken apart.
std::optional<Eigen::VectorXd> WindowState::preview(const Information& information) const {
  const std::vector<int>& w = information.coordinates;
  Eigen::MatrixXf M = ownCovarianceTimes(*this, w, information.matrix);
  M.diagonal().array() += 1;
  const Eigen::PartialPivLU<Eigen::Ref<Eigen::MatrixXf>> inner(M);
  const Eigen::VectorXf right =
      (rowsOf(colsOf(covariance(), w), w) * information.vector).cast<float>();
  const Eigen::VectorXd error = inner.solve(right).cast<double>();
  if (!error.allFinite()) return std::nullopt;
  return error;
}

bool WindowState::update(const Information& information) {
  if (!information.matrix.allFinite() || !information.vector.allFinite()) return false;
  const auto correction = Correction::by(information, *this);
  if (!correction) return false;
  if (correction->error().size() == 0) return true;
  auto P = covariance_.all();
  const Eigen::VectorXd& error = correction->error();

  // P - G G', of which then the dilation is turned: (I - T S) (P - G G') (I - T S)', S picking
  // bias and scale.
  const Stretch T = stretchBy(error);
  const Stretch P_s = P.middleCols<4>(kBias) - correction->gainTimesRows(kBias);
  const Stretch V = P_s - 0.5 * T * P_s.middleRows<4>(kBias);
  correction->subtractFrom(P, T, V);
  inject(error);
  return true;
}

void WindowState::inject(const Eigen::VectorXd& error) {
  R_map_odom_ = rotationOf(error.segment<3>(kAttitude)) * R_map_odom_;
  R_base_rig_ = rotationOf(error.segment<3>(kExtrinsics)) * R_base_rig_;
  velocity_bias_m_s_ += error.segment<3>(kBias);
  scale_error_ += error(kScale);
  floor_map_m_ += error(kFloor);
  const auto correct = [&](Clone& pose, int at, double stretched) {
    pose.position_map += error.segment<3>(at);
    pose.R_map_rig = rotationOf(error.segment<3>(at + 3)) * pose.R_map_rig;
    pose.stretch *= 1 - (pose.is_loaded ? 0 : error(kScale)) - stretched;
  };
  for (std::size_t i = 0; i < anchors_.size(); ++i) {
    const int at = anchorCoordinate(i);
    correct(anchors_[i], at, error(at + kFrame));
  }
  for (std::size_t i = 0; i < frames_.size(); ++i)
    correct(frames_[i], frameCoordinate(i),
            frames_[i].stretch_by_bias_s_m.dot(error.segment<3>(kBias)));
}

// A scale error stretches map and window as they now are, not as they were: the covariance must
// say so, or later tracks would take the difference for a sight of the scale. The velocity's
// bias stretches the steps of the window alone, each in its way.
WindowState::Stretch WindowState::stretchBy(const Eigen::VectorXd& error) const {
  Stretch T = Stretch::Zero(error.size(), 4);
  const auto scaled = [&](int at) { T.block<3, 1>(at, kScale - kBias) = error.segment<3>(at); };
  T(kFloor, kScale - kBias) = error(kFloor);
  for (std::size_t i = 0; i < anchors_.size(); ++i) {
    if (!anchors_[i].is_loaded) scaled(anchorCoordinate(i));
  }
  scaled(frameCoordinate(frames_.size() - 1));
  for (std::size_t i = frames_.size() - 1; i-- > 0;) {
    const int at = frameCoordinate(i);
    const int next = frameCoordinate(i + 1);
    scaled(at);
    T.block<3, 3>(at, 0) =
        T.block<3, 3>(next, 0) + (error.segment<3>(at) - error.segment<3>(next)) *
                                     frames_[i + 1].stretch_by_bias_s_m.transpose();
  }
  return T;
}

}  // namespace ardrone_vslam
