// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/time_offset.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "ardrone_vslam/rotation.hpp"
#include "odometry/time_offset_state.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kCorner_px = 0.7;       // deviation between two images, per axis
constexpr double kAttitude_rad = 0.002;  // white deviation of a turn by the odometry, per axis
constexpr double kCalibration = 0.02;    // of a turn, by focal length and lens
constexpr double kDrift_rad_s = 0.02;    // deviation of the rates' constant difference
constexpr double kVelocity_m_s = 0.05;   // deviation of the odometry's velocity, per axis
constexpr double kOdometryScale = 0.05;  // and of its scale
constexpr double kDepth_m = 3;           // of the scene, roughly
constexpr std::size_t kMostPairs = 120;  // more tracks cost time and say little
constexpr double kScale = 0.1;           // deviation of the turns' constant relative difference
constexpr double kOutlierSigmas = 5;     // of a turn
constexpr double kFewestTurns = 30;      // in the sums
constexpr double kClearTurn = 16;        // mean square of turns, in deviations: no noise
constexpr double kAlike = 4;             // mean square that may stay; usual is below 1
constexpr double kSignificant = 5;       // times what noise makes of the squares
constexpr std::size_t kParabola = 5;     // grid points to each side of the minimum
constexpr double kLikeNeighbours = 2;    // turns of neighbouring images share their errors
constexpr double kFloor_s = 0.001;       // smoothing and grid
constexpr std::size_t kSmoothing = 2;    // grid points to each side

double seconds(std::int64_t nanoseconds) {
  return static_cast<double>(nanoseconds) * 1e-9;
}

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

struct Parabola {
  double slope = 0;  // in its middle, per grid step
  double curvature = 0;
};

/// Least squares through 2 kParabola + 1 points.
Parabola parabolaThrough(const double* points) {
  double count = 0, x2 = 0, x4 = 0, y = 0, xy = 0, x2y = 0;
  for (std::size_t i = 0; i <= 2 * kParabola; ++i) {
    const double x = static_cast<double>(i) - static_cast<double>(kParabola);
    count += 1;
    x2 += x * x;
    x4 += x * x * x * x;
    y += points[i];
    xy += x * points[i];
    x2y += x * x * points[i];
  }
  return {xy / x2, 2 * (count * x2y - x2 * y) / (count * x4 - x2 * x2)};
}

Matrix6d priorOfConstants() {
  Vector6d information;
  information.head<3>().setConstant(1 / (kDrift_rad_s * kDrift_rad_s));
  information.tail<3>().setConstant(1 / (kScale * kScale));
  return information.asDiagonal();
}

}  // namespace

TimeOffsetEstimator::State::State(const Eigen::Isometry3d& T_base_cam, double centre_s)
    : T_base_cam_(T_base_cam),
      centre_ns_(std::llround(centre_s * 1e9)),
      constants_(priorOfConstants()),
      solver_(constants_) {}

void TimeOffsetEstimator::State::useCamera(const Eigen::Isometry3d& T_base_cam) {
  T_base_cam_ = T_base_cam;
  forgetImages();
}

void TimeOffsetEstimator::State::forgetImages() {
  used_ = taken_ = 0;
  added_ns_ = 0;
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
  now.stamp_ns = features.stamp_ns;
  now.focal_length_px = features.focal_length_px;
  now.has_odometry = false;
  now.rays.clear();
  order_.reset(features);
  for (const TrackedFeature& one : order_)
    now.rays.push_back({one.track_id, features.bearing_cam[one.feature]});
  ++taken_;
  used_ = std::max(used_, taken_ - std::min(taken_, kImages / 2));
}

bool TimeOffsetEstimator::State::findOdometry(Image& image, const OdometryBuffer& odometry) const {
  std::array<Eigen::Quaterniond, kOffsets + 2 * kSmoothing> around;
  const Eigen::Quaterniond q_base_cam(T_base_cam_.linear());
  OdometryState state;
  for (std::size_t i = 0; i < around.size(); ++i) {
    const auto steps = static_cast<std::int64_t>(i) - static_cast<std::int64_t>(around.size() / 2);
    const std::int64_t stamp_ns = image.stamp_ns + centre_ns_ + steps * kGrid_ns;
    if (odometry.at(stamp_ns, state) != OdometryBuffer::Lookup::kFound) return false;
    around[i] = Eigen::Quaterniond(state.T_odom_base.linear()) * q_base_cam;
    if (steps == 0) image.camera_odom_m = state.T_odom_base * T_base_cam_.translation();
  }
  for (std::size_t i = 0; i < kOffsets; ++i)
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
    const auto turn = turnBetween(then, now);
    if (turn) return add(then, now, *turn);
  }
}

DisplacementGuess TimeOffsetEstimator::State::wayBetween(const Image& then, const Image& now) {
  DisplacementGuess guess;
  guess.displacement_m =
      then.q_odom_cam[kHalf].conjugate() * (now.camera_odom_m - then.camera_odom_m);
  guess.sigma_m = kVelocity_m_s * seconds(now.stamp_ns - then.stamp_ns) +
                  kOdometryScale * guess.displacement_m.norm();
  return guess;
}

std::optional<ImageRotation> TimeOffsetEstimator::State::turnBetween(const Image& then,
                                                                     const Image& now) {
  pairs_.clear();
  auto ray = then.rays.begin();
  for (const Ray& one : now.rays) {
    while (ray != then.rays.end() && ray->track_id < one.track_id) ++ray;
    if (ray == then.rays.end()) break;
    if (ray->track_id != one.track_id) continue;
    pairs_.push_back({ray->bearing_cam.cast<double>(), one.bearing_cam.cast<double>()});
  }
  if (pairs_.size() > kMostPairs) {
    for (std::size_t i = 0; i < kMostPairs; ++i) pairs_[i] = pairs_[i * pairs_.size() / kMostPairs];
    pairs_.resize(kMostPairs);
  }
  return fitTurn(pairs_, kCorner_px / now.focal_length_px, wayBetween(then, now));
}

void TimeOffsetEstimator::State::add(const Image& then, const Image& now,
                                     const ImageRotation& turn) {
  const double span_s = seconds(now.stamp_ns - then.stamp_ns);
  const Eigen::Vector3d rotation_rad = rotationVectorOf(turn.R_then_now);
  const double other_rad = kAttitude_rad + kCalibration * rotation_rad.norm();
  // A short way across looks like yaw or pitch of the camera, but not like roll.
  const double hidden_rad = wayBetween(then, now).sigma_m / kDepth_m;
  Eigen::Vector3d other_rad2 = Eigen::Vector3d::Constant(other_rad * other_rad);
  other_rad2.head<2>().array() += hidden_rad * hidden_rad;
  // As (information^-1 + others)^-1 where some directions have no information.
  const Eigen::Matrix3d softened = turn.information * other_rad2.asDiagonal();
  const Eigen::Matrix3d information =
      (Eigen::Matrix3d::Identity() + softened).inverse() * turn.information;
  if (!information.allFinite()) return;

  const Eigen::Quaterniond q_now_then(turn.R_then_now.transpose());
  std::array<Eigen::Vector3d, kOffsets> differences_rad;
  for (std::size_t i = 0; i < kOffsets; ++i) {
    const Eigen::Quaterniond q_difference =
        then.q_odom_cam[i].conjugate() * now.q_odom_cam[i] * q_now_then;
    differences_rad[i] = std::copysign(2, q_difference.w()) * q_difference.vec();  // small
  }
  Eigen::Matrix<double, 3, 6> J;  // of a difference by the constant ones
  J << span_s * Eigen::Matrix3d::Identity(), Eigen::Matrix3d(rotation_rad.asDiagonal());
  const Eigen::Vector3d off_rad = differences_rad[best_] - J * constantsAt(best_);
  const double off = off_rad.dot(information * off_rad) / (kOutlierSigmas * kOutlierSigmas);
  const double weight = turns_ < kFewestTurns ? 1 : 1 / ((1 + off) * (1 + off));

  const double passed_s = added_ns_ != 0 ? seconds(now.stamp_ns - added_ns_) : 0;
  added_ns_ = now.stamp_ns;
  const double kept = std::exp(-passed_s / kMemory_s);
  for (std::size_t i = 0; i < kOffsets; ++i) {
    const Eigen::Vector3d weighed = weight * (information * differences_rad[i]);
    offsets_[i].squares = kept * offsets_[i].squares + differences_rad[i].dot(weighed);
    offsets_[i].gradient = kept * offsets_[i].gradient + J.transpose() * weighed;
  }
  const Matrix6d prior = priorOfConstants();
  constants_ = prior + kept * (constants_ - prior) + weight * J.transpose() * information * J;
  solver_.compute(constants_);
  turns_ = kept * turns_ + weight;
  turned_ = kept * turned_ + weight * rotation_rad.dot(information * rotation_rad);
  findMinimum();
}

Vector6d TimeOffsetEstimator::State::constantsAt(std::size_t offset) const {
  return solver_.solve(offsets_[offset].gradient);
}

void TimeOffsetEstimator::State::findMinimum() {
  for (std::size_t i = 0; i < kOffsets; ++i)
    squares_[i] = offsets_[i].squares - offsets_[i].gradient.dot(constantsAt(i));
  best_ = static_cast<std::size_t>(std::min_element(squares_.begin(), squares_.end()) -
                                   squares_.begin());
  estimate_ = {};
  if (turns_ < kFewestTurns) return;
  const double per_turn = std::max(squares_[best_], 0.0) / (3 * turns_);
  const double ripple = std::sqrt(6 * turns_) * per_turn;  // by white noise of the attitude
  const double contrast = *std::max_element(squares_.begin(), squares_.end()) - squares_[best_];
  if (turned_ > kClearTurn * 3 * turns_ && per_turn > kAlike) {
    estimate_.state = TimeOffsetState::kDisagreement;
    return;
  }
  estimate_.state = TimeOffsetState::kTooLittleTurn;
  if (contrast < kSignificant * ripple) return;
  if (best_ < kParabola || best_ + kParabola >= kOffsets) {
    estimate_.state = TimeOffsetState::kOutOfReach;
    return;
  }
  const Parabola parabola = parabolaThrough(&squares_[best_ - kParabola]);
  if (!(parabola.curvature > 0)) return;
  const double grid_s = seconds(kGrid_ns);
  const double half_s = static_cast<double>(kParabola) * grid_s;
  const double curvature_per_s2 = parabola.curvature / (grid_s * grid_s);
  const double by_turns_s2 = kLikeNeighbours * per_turn * 2 / curvature_per_s2;
  const double by_ripple_s = ripple / (half_s * curvature_per_s2);
  const double variance_s2 = by_turns_s2 + by_ripple_s * by_ripple_s + kFloor_s * kFloor_s;
  if (variance_s2 > kSure_s * kSure_s) return;
  estimate_.state = TimeOffsetState::kKnown;
  estimate_.deviation_s = std::sqrt(variance_s2);
  const double minimum = static_cast<double>(best_) - parabola.slope / parabola.curvature;
  estimate_.offset_s = seconds(centre_ns_ - kReach_ns) + minimum * grid_s;
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
