// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/time_offset.hpp"

#include <algorithm>
#include <cmath>

#include "linear/scalars.hpp"
#include "setup/time_offset_state.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kVelocityNoise_m_s = 0.05;  // sigma of the odometry's velocity, per axis
constexpr double kOdometryScale = 0.05;      // and of its scale
constexpr std::size_t kSmoothing = 2;        // grid points to each side

/// Of small turns to and from the middle; white noise of the attitude averages out.
Eigen::Quaterniond meanOf(const Eigen::Quaterniond* first, std::size_t count) {
  const Eigen::Quaterniond& middle = first[count / 2];
  Eigen::Vector4d sum = Eigen::Vector4d::Zero();
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector4d q = first[i].coeffs();
    sum += q.dot(middle.coeffs()) < 0 ? Eigen::Vector4d(-q) : q;
  }
  return Eigen::Quaterniond(Eigen::Vector4d(sum.normalized()));
}

}  // namespace

TimeOffsetEstimator::State::State(const Eigen::Isometry3d& T_base_cam, double centre_s)
    : T_base_cam_(T_base_cam), centre_ns_(std::llround(centre_s * 1e9)), sums_(centre_ns_) {}

void TimeOffsetEstimator::State::useCamera(const Eigen::Isometry3d& T_base_cam) {
  T_base_cam_ = T_base_cam;
  forgetImages();
}

void TimeOffsetEstimator::State::forgetImages() {
  used_ = taken_ = 0;
  sums_.breakOff();
}

void TimeOffsetEstimator::State::see(const ImageFeatures& features,
                                     const OdometryBuffer& odometry) {
  if (taken_ > 0 && features.stamp_ns < image(taken_ - 1).stamp_ns) forgetImages();
  if (taken_ == 0 || features.stamp_ns - image(taken_ - 1).stamp_ns >= kStep_ns) take(features);
  constexpr auto kAround_ns = static_cast<std::int64_t>(kSmoothing) * kGrid_ns + kReach_ns;
  for (; used_ < taken_ && image(used_).stamp_ns + kAround_ns <= features.stamp_ns; ++used_) {
    image(used_).has_odometry = findOdometry(image(used_), odometry);
    if (image(used_).has_odometry) compare(used_);
  }
}

void TimeOffsetEstimator::State::take(const ImageFeatures& features) {
  Image& now = image(taken_);
  now.take(features, order_);
  now.has_odometry = false;
  ++taken_;
  used_ = std::max(used_, taken_ - std::min(taken_, kImages / 2));
}

bool TimeOffsetEstimator::State::findOdometry(Image& image, const OdometryBuffer& odometry) const {
  std::array<Eigen::Quaterniond, kOffsetCount + 2 * kSmoothing> around;
  const Eigen::Quaterniond q_base_cam(T_base_cam_.linear());
  OdometryState state;
  for (std::size_t i = 0; i < around.size(); ++i) {
    const auto steps = static_cast<std::int64_t>(i) - static_cast<std::int64_t>(around.size() / 2);
    const std::int64_t stamp_ns = image.stamp_ns + centre_ns_ + steps * kGrid_ns;
    if (odometry.at(stamp_ns, state) != OdometryBuffer::Lookup::kFound) return false;
    around[i] = Eigen::Quaterniond(state.T_odom_base.linear()) * q_base_cam;
    if (steps == 0) image.camera_odom_m = state.T_odom_base * T_base_cam_.translation();
  }
  for (std::size_t i = 0; i < kOffsetCount; ++i)
    image.q_odom_cam[i] = meanOf(&around[i], 2 * kSmoothing + 1);
  return true;
}

/// With the image kSpan_ns before, or the oldest one after that with enough tracks in common.
void TimeOffsetEstimator::State::compare(std::size_t number) {
  const Image& now = image(number);
  for (std::size_t i = number - std::min(number, kImages / 2 - 1); i < number; ++i) {
    const Image& then = image(i);
    const std::int64_t span_ns = now.stamp_ns - then.stamp_ns;
    if (span_ns > kSpan_ns + kStep_ns || !then.has_odometry) continue;
    const auto rotation = rotationBetween(then, now);
    if (!rotation) continue;
    return sums_.add({now.stamp_ns, seconds(span_ns), then.q_odom_cam, now.q_odom_cam, *rotation,
                      displacementBetween(then, now).sigma_m});
  }
}

DisplacementGuess TimeOffsetEstimator::State::displacementBetween(const Image& then,
                                                                  const Image& now) {
  DisplacementGuess guess;
  guess.displacement_m =
      then.q_odom_cam[kMiddleOffset].conjugate() * (now.camera_odom_m - then.camera_odom_m);
  guess.sigma_m = kVelocityNoise_m_s * seconds(now.stamp_ns - then.stamp_ns) +
                  kOdometryScale * guess.displacement_m.norm();
  return guess;
}

std::optional<ImageRotation> TimeOffsetEstimator::State::rotationBetween(const Image& then,
                                                                         const Image& now) {
  findPairs(then, now, pairs_);
  return fitRotation(pairs_, kCornerSigma_px / now.focal_length_px, displacementBetween(then, now));
}

TimeOffsetEstimator::TimeOffsetEstimator(const Eigen::Isometry3d& T_base_cam, double centre_s)
    : state_(std::make_unique<State>(T_base_cam, centre_s)) {}

TimeOffsetEstimator::~TimeOffsetEstimator() = default;

void TimeOffsetEstimator::see(const ImageFeatures& features, const OdometryBuffer& odometry) {
  state_->see(features, odometry);
}

const TimeOffset& TimeOffsetEstimator::estimate() const {
  return state_->estimate();
}

void TimeOffsetEstimator::useCamera(const Eigen::Isometry3d& T_base_cam) {
  state_->useCamera(T_base_cam);
}

}  // namespace ardrone_vslam
