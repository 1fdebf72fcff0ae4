// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/window_state.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "ardrone_vslam/rotation.hpp"
#include "covariance_blocks.hpp"

namespace ardrone_vslam {
namespace {

constexpr int kAttitude = 0;
constexpr int kBias = 3;
constexpr double kSpeedSmoothing_s = 2;

double squared(double value) {
  return value * value;
}

double radians(double degrees) {
  return degrees * M_PI / 180;
}

Eigen::Matrix3d acrossOf(const Eigen::Vector3d& unit) {
  return Eigen::Matrix3d::Identity() - unit * unit.transpose();
}

/// Where the coordinates that two ascending lists share stand in each of them.
struct Places {
  std::vector<int> in_first;
  std::vector<int> in_second;

  Places(const std::vector<int>& first, const std::vector<int>& second) {
    std::size_t k = 0;
    for (std::size_t i = 0; i < first.size(); ++i) {
      while (k < second.size() && second[k] < first[i]) ++k;
      if (k == second.size() || second[k] != first[i]) continue;
      in_first.push_back(static_cast<int>(i));
      in_second.push_back(static_cast<int>(k));
    }
  }

  /// Of information on the first list: on the shared coordinates alone.
  Information only(const Information& information) const {
    std::vector<int> coordinates;
    coordinates.reserve(in_first.size());
    for (const int i : in_first)
      coordinates.push_back(information.coordinates[static_cast<std::size_t>(i)]);
    Information shared(std::move(coordinates));
    shared.matrix = information.matrix(in_first, in_first);
    for (std::size_t i = 0; i < in_first.size(); ++i)
      shared.vector(static_cast<Eigen::Index>(i)) = information.vector(in_first[i]);
    return shared;
  }
};

/// Zeros but for these coordinates.
Eigen::VectorXd spread(const Eigen::VectorXd& values, const std::vector<int>& coordinates,
                       Eigen::Index size) {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(size);
  for (std::size_t i = 0; i < coordinates.size(); ++i)
    all(coordinates[i]) = values(static_cast<Eigen::Index>(i));
  return all;
}

/// Kalman update of a covariance.
/// @return the error to correct; nothing when the covariance is not positive or the result not
/// finite, and then nothing is changed
std::optional<Eigen::VectorXd> condition(const Information& information, Eigen::MatrixXd& P) {
  const std::vector<int>& w = information.coordinates;
  const auto size = static_cast<Eigen::Index>(w.size());
  // With P_ww = C C' and N = C' information C the posterior is P - G (I - (I + N)^-1) G', where
  // G = P_w C'^-1: positive whatever the rank of the information.
  constexpr double kRounding = 1e-14;
  const Eigen::MatrixXd P_ww = P(w, w);
  const Eigen::LLT<Eigen::MatrixXd> prior(P_ww + kRounding * Eigen::MatrixXd::Identity(size, size));
  if (prior.info() != Eigen::Success) return std::nullopt;
  const Eigen::MatrixXd C = prior.matrixL();
  Eigen::MatrixXd M = C.transpose() * information.matrix * C;
  M.diagonal().array() += 1;
  const Eigen::LLT<Eigen::MatrixXd> inner(M);
  if (inner.info() != Eigen::Success) return std::nullopt;
  const Eigen::MatrixXd P_w = P(Eigen::all, w);
  const Eigen::MatrixXd G = prior.matrixL().solve(P_w.transpose()).transpose();
  const Eigen::VectorXd error = G * inner.solve(C.transpose() * information.vector);
  if (!error.allFinite()) return std::nullopt;

  const Eigen::MatrixXd gain =
      Eigen::MatrixXd::Identity(size, size) - inner.solve(Eigen::MatrixXd::Identity(size, size));
  P -= G * (gain * G.transpose());
  P = (0.5 * (P + P.transpose())).eval();
  return error;
}

}  // namespace

Information::Information(std::vector<int> of_coordinates) : coordinates(std::move(of_coordinates)) {
  const auto size = static_cast<Eigen::Index>(coordinates.size());
  matrix = Eigen::MatrixXd::Zero(size, size);
  vector = Eigen::VectorXd::Zero(size);
}

WindowState::WindowState(const ObserverNoiseConfig& config, bool attitude_states)
    : config_(config), attitude_states_(attitude_states) {
  validate(config);
  if (attitude_states) return;
  config_.tilt_deviation_deg = 0;
  config_.yaw_walk_deg_per_sqrt_s = 0;
  config_.yaw_walk_deg_per_sqrt_m = 0;
  config_.attitude_noise_deg = 0;
  config_.mounting_deviation_deg = 0;
}

void WindowState::start(const ObserverState& observer) {
  observer_ = observer;
  R_map_odom_.setIdentity();
  R_mounting_.setIdentity();
  inflation_ = 1;
  velocity_bias_m_s_.setZero();
  scale_error_ = 0;
  speed_error_m_s_ = 0;
  speed_m_s_ = 0;
  floor_map_m_ = 0;
  anchors_.clear();
  frames_.assign(1, {next_id_++, observer.stamp_ns, observer.T_odom_base.translation(),
                     observer.T_odom_base.linear(), config_.slow_speed_m_s, 1});
  P_ = Eigen::MatrixXd::Zero(kGlobals + kFrame, kGlobals + kFrame);
  P_.diagonal().segment<3>(kBias).setConstant(squared(config_.velocity_bias_m_s));
  P_(kScale, kScale) = squared(config_.scale_deviation);
  P_(kSpeed, kSpeed) = squared(config_.velocity_bias_m_s);
  // Yaw is zero by definition; roll and pitch may be off from the start.
  const Eigen::Matrix3d tilt =
      squared(radians(config_.tilt_deviation_deg)) * acrossOf(observer.T_odom_base.linear().col(2));
  const int attitude = kGlobals + 3;
  P_.block<3, 3>(kAttitude, kAttitude) = tilt;
  P_.block<3, 3>(attitude, kAttitude) = tilt;
  P_.block<3, 3>(kAttitude, attitude) = tilt;
  P_.block<3, 3>(attitude, attitude) = tilt;
  P_.diagonal().segment<3>(kMounting).setConstant(squared(radians(config_.mounting_deviation_deg)));
  P_.block<3, 3>(attitude, kMounting) =
      observer.T_odom_base.linear() * P_.block<3, 3>(kMounting, kMounting);
  P_.block<3, 3>(kMounting, attitude) = P_.block<3, 3>(attitude, kMounting).transpose();
  P_.diagonal().segment<3>(attitude).array() += squared(radians(config_.attitude_noise_deg)) +
                                                squared(radians(config_.mounting_deviation_deg));
  P_.diagonal().segment<3>(kGlobals).setConstant(squared(config_.start_deviation_m));
}

void WindowState::propagate(const ObserverState& observer) {
  const WindowPose last = frames_.back();
  const double dt_s =
      std::max(static_cast<double>(observer.stamp_ns - observer_.stamp_ns) * 1e-9, 0.0);
  const Eigen::Vector3d step_odom =
      observer.T_odom_base.translation() - observer_.T_odom_base.translation();
  const double way_m = step_odom.norm();
  if (dt_s > 0) {
    const double share = speed_m_s_ > 0 ? dt_s / (dt_s + kSpeedSmoothing_s) : 1;
    speed_m_s_ += share * (way_m / dt_s - speed_m_s_);
  }

  WindowPose next;
  next.id = next_id_++;
  next.stamp_ns = observer.stamp_ns;
  next.speed_m_s = std::max(speed_m_s_, config_.slow_speed_m_s);
  const Eigen::Vector3d step =
      R_map_odom_ * step_odom * (1 - scale_error_ - speed_error_m_s_ / next.speed_m_s);
  // Along the way the bias gives way to the speed error as the drone moves.
  const double slow_m = config_.slow_speed_m_s * dt_s;
  const double moving = way_m > 0 ? step.squaredNorm() / (step.squaredNorm() + slow_m * slow_m) : 0;
  const Eigen::Vector3d along = step.normalized();
  const Eigen::Matrix3d bias_to_step =
      (Eigen::Matrix3d::Identity() - moving * along * along.transpose()) * R_map_odom_ *
      observer_.T_odom_base.linear() * dt_s;
  const Eigen::Vector3d moved = step - bias_to_step * velocity_bias_m_s_;
  next.position_map = last.position_map + moved;

  const int from = frameCoordinate(frames_.size() - 1);
  const int to = frameCoordinate(frames_.size());
  P_ = widened(P_, to, kFrame);
  Eigen::Matrix<double, 3, kGlobals> F = Eigen::Matrix<double, 3, kGlobals>::Zero();
  F.middleCols<3>(kAttitude) = -skew(moved);
  F.middleCols<3>(kBias) = -bias_to_step;
  F.col(kScale) = -moved;
  F.col(kSpeed) = -moved / next.speed_m_s;
  P_.middleRows<3>(to) = P_.middleRows<3>(from) + F * P_.topRows<kGlobals>();
  P_.middleCols<3>(to) = P_.middleCols<3>(from) + P_.leftCols<kGlobals>() * F.transpose();
  const std::optional<double> then = positionVariance_m2(observer_);
  const std::optional<double> now = positionVariance_m2(observer);
  P_.diagonal().segment<3>(to).array() +=
      then && now && *now > *then
          ? *now - *then
          : squared(config_.walk_m_per_sqrt_m) * way_m + squared(config_.walk_m_per_sqrt_s) * dt_s;

  propagateGlobals(observer, dt_s, way_m);
  const Eigen::Matrix3d R_map_base = R_map_odom_ * observer.T_odom_base.linear();
  next.R_map_base = R_map_base * R_mounting_;
  P_.middleRows<3>(to + 3) = P_.middleRows<3>(kAttitude) + R_map_base * P_.middleRows<3>(kMounting);
  P_.middleCols<3>(to + 3) =
      P_.middleCols<3>(kAttitude) + P_.middleCols<3>(kMounting) * R_map_base.transpose();
  P_.diagonal().segment<3>(to + 3).array() += squared(radians(config_.attitude_noise_deg));
  frames_.push_back(next);
  observer_ = observer;
}

void WindowState::inflate(double factor) {
  const double more = (factor - inflation_) * squared(config_.velocity_bias_m_s);
  inflation_ = factor;
  if (more <= 0) return;
  P_.diagonal().segment<3>(kBias).array() += more;
  P_(kSpeed, kSpeed) += more;
}

void WindowState::propagateGlobals(const ObserverState& observer, double dt_s, double way_m) {
  // Roll and pitch come back to the observer's, which gravity holds; yaw walks; biases fade.
  const Eigen::Vector3d up = R_map_odom_ * observer.T_odom_base.linear().col(2);
  const double keep_tilt = std::exp(-dt_s / config_.tilt_time_s);
  const double keep_bias = std::exp(-dt_s / config_.velocity_bias_time_s);
  R_map_odom_ =
      rotationOf(-(1 - keep_tilt) * acrossOf(up) * rotationVectorOf(R_map_odom_)) * R_map_odom_;
  velocity_bias_m_s_ *= keep_bias;
  speed_error_m_s_ *= keep_bias;

  Eigen::Matrix<double, kGlobals, kGlobals> F =
      Eigen::Matrix<double, kGlobals, kGlobals>::Identity();
  F.block<3, 3>(kAttitude, kAttitude) -= (1 - keep_tilt) * acrossOf(up);
  F.diagonal().segment<3>(kBias).setConstant(keep_bias);
  F(kSpeed, kSpeed) = keep_bias;
  P_.topRows<kGlobals>() = (F * P_.topRows<kGlobals>()).eval();
  P_.leftCols<kGlobals>() = (P_.leftCols<kGlobals>() * F.transpose()).eval();
  const double tilt_variance =
      squared(radians(config_.tilt_deviation_deg)) * (1 - keep_tilt * keep_tilt);
  const double yaw_variance = squared(radians(config_.yaw_walk_deg_per_sqrt_s)) * dt_s +
                              squared(radians(config_.yaw_walk_deg_per_sqrt_m)) * way_m;
  const double bias_variance =
      inflation_ * squared(config_.velocity_bias_m_s) * (1 - keep_bias * keep_bias);
  P_.block<3, 3>(kAttitude, kAttitude) +=
      tilt_variance * acrossOf(up) + yaw_variance * up * up.transpose();
  P_.diagonal().segment<3>(kBias).array() += bias_variance;
  P_(kSpeed, kSpeed) += bias_variance;
}

void WindowState::holdNewest(std::size_t reference, const Eigen::Vector3d& camera_base,
                             const Eigen::Matrix3d& deviation_m2) {
  const WindowPose& then = frames_[reference];
  WindowPose& newest = frames_.back();
  const Eigen::Vector3d lever_then = then.R_map_base * camera_base;
  const Eigen::Vector3d lever = newest.R_map_base * camera_base;
  newest.position_map = then.position_map + lever_then - lever;
  const int from = frameCoordinate(reference);
  const int to = frameCoordinate(frames_.size() - 1);
  P_.middleRows<3>(to) = (P_.middleRows<3>(from) - skew(lever_then) * P_.middleRows<3>(from + 3) +
                          skew(lever) * P_.middleRows<3>(to + 3))
                             .eval();
  P_.middleCols<3>(to) =
      (P_.middleCols<3>(from) - P_.middleCols<3>(from + 3) * skew(lever_then).transpose() +
       P_.middleCols<3>(to + 3) * skew(lever).transpose())
          .eval();
  P_.block<3, 3>(to, to) += deviation_m2;
}

void WindowState::beginFloor(double height_m, double variance_m2) {
  floor_map_m_ = frames_.back().position_map.z() - height_m;
  const int z = frameCoordinate(frames_.size() - 1) + 2;
  P_.row(kFloor) = P_.row(z).eval();
  P_.col(kFloor) = P_.col(z).eval();
  P_(kFloor, kFloor) += variance_m2;
}

std::vector<int> WindowState::uncertain() const {
  std::vector<int> coordinates;
  const auto add = [&coordinates](int first, int count) {
    for (int k = first; k < first + count; ++k) coordinates.push_back(k);
  };
  add(kBias, kMounting - kBias);
  add(kFloor, kGlobals - kFloor);
  for (std::size_t i = 0; i < frames_.size(); ++i) add(frameCoordinate(i), 3);
  for (std::size_t i = 0; i < anchors_.size(); ++i) {
    add(anchorCoordinate(i), 3);
    add(anchorCoordinate(i) + kFrame, kAnchor - kFrame);
  }
  return coordinates;
}

std::optional<Eigen::VectorXd> WindowState::preview(const Information& information) const {
  const auto previewOn = [this](const Information& its) -> std::optional<Eigen::VectorXd> {
    const Eigen::MatrixXd P_ww = P_(its.coordinates, its.coordinates);
    Eigen::MatrixXd M = P_ww * its.matrix;
    M.diagonal().array() += 1;
    const Eigen::VectorXd error = M.partialPivLu().solve(P_ww * its.vector);
    if (!error.allFinite()) return std::nullopt;
    return error;
  };
  if (attitude_states_) return previewOn(information);
  const Places places(information.coordinates, uncertain());
  const auto error = previewOn(places.only(information));
  if (!error) return std::nullopt;
  return spread(*error, places.in_first, information.vector.size());
}

bool WindowState::update(const Information& information) {
  if (attitude_states_) {
    const auto error = condition(information, P_);
    if (error) inject(*error);
    return error.has_value();
  }
  const std::vector<int> states = uncertain();
  const Places places(information.coordinates, states);
  Information its = places.only(information);
  its.coordinates = places.in_second;
  Eigen::MatrixXd P = P_(states, states);
  const auto error = condition(its, P);
  if (!error) return false;
  P_(states, states) = P;
  inject(spread(*error, states, P_.rows()));
  return true;
}

void WindowState::inject(const Eigen::VectorXd& error) {
  R_map_odom_ = rotationOf(error.segment<3>(kAttitude)) * R_map_odom_;
  R_mounting_ = rotationOf(error.segment<3>(kMounting)) * R_mounting_;
  velocity_bias_m_s_ += error.segment<3>(kBias);
  scale_error_ += error(kScale);
  speed_error_m_s_ += error(kSpeed);
  floor_map_m_ += error(kFloor);
  // A scale error stretches map and window as they now are, not as they were: the covariance must
  // say so, or later constraints would take the difference for a sight of the scale. The speed's
  // error stretches the window alone, about the newest frame.
  Eigen::MatrixXd T = Eigen::MatrixXd::Zero(error.size(), 2);
  const auto correct = [&](WindowPose& pose, int at, double speed_error_m_s) {
    pose.position_map += error.segment<3>(at);
    pose.R_map_base = rotationOf(error.segment<3>(at + 3)) * pose.R_map_base;
    pose.stretch *= 1 - error(kScale) - speed_error_m_s / pose.speed_m_s;
    T.block<3, 1>(at, 0) = error.segment<3>(at);
  };
  T(kFloor, 0) = error(kFloor);
  const Eigen::Vector3d shift = error.segment<3>(frameCoordinate(frames_.size() - 1));
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    const int at = frameCoordinate(i);
    correct(frames_[i], at, error(kSpeed));
    T.block<3, 1>(at, 1) = (error.segment<3>(at) - shift) / frames_[i].speed_m_s;
  }
  for (std::size_t i = 0; i < anchors_.size(); ++i) {
    const int at = anchorCoordinate(i);
    correct(anchors_[i], at, error(at + kFrame));
  }
  P_ -= (T * P_.middleRows<2>(kScale)).eval();
  P_ -= (P_.middleCols<2>(kScale) * T.transpose()).eval();
}

void WindowState::removeFrame(std::size_t frame) {
  P_ = without(P_, frameCoordinate(frame), kFrame);
  frames_.erase(frames_.begin() + static_cast<std::ptrdiff_t>(frame));
}

void WindowState::makeAnchor(std::size_t frame) {
  const int first = frameCoordinate(frame);
  const int behind = first + kFrame;
  P_ = picked(
      P_,
      {{0, first}, {behind, static_cast<int>(P_.rows()) - behind}, {first, kFrame}, {kSpeed, 1}});
  anchors_.push_back(frames_[frame]);
  frames_.erase(frames_.begin() + static_cast<std::ptrdiff_t>(frame));
}

void WindowState::removeAnchor(std::size_t anchor) {
  P_ = without(P_, anchorCoordinate(anchor), kAnchor);
  anchors_.erase(anchors_.begin() + static_cast<std::ptrdiff_t>(anchor));
}

}  // namespace ardrone_vslam
