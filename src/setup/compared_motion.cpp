// SPDX-License-Identifier: BSD-3-Clause
#include "setup/compared_motion.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "ardrone_vslam/rotation.hpp"
#include "linear/portable_math.hpp"

namespace ardrone_vslam {
namespace {

using Vector5d = Eigen::Matrix<double, 5, 1>;

constexpr double kAttitude_rad = 0.005;  // sigma of a turn by the odometry, per axis
constexpr double kOfRotation = 0.05;     // and as a share of it: calibration, clocks
constexpr double kDirection_rad = 0.1;   // of a way: many tracks of a street err alike
constexpr double kVelocity_m_s = 0.4;    // of the odometry: three times that of a bad one
constexpr double kSlowest_m_s = 0.6;     // below it the odometry tells no direction
constexpr double kNoDirection_rad = 10;
constexpr double kUsual = 3;           // squares below this speak against nothing
constexpr double kAgrees = 12;         // squares above this are looked into
constexpr double kMostOutliers = 0.4;  // share of the tracks, or the motion is not known
constexpr double kFewOutliers = 0.25;  // share below which the first fit will do
constexpr double kAsGood = 0.05;       // share of the tracks by which fits may differ
constexpr double kAnywhere_m = 10;     // sigma of a way that is not known

double directionSigma_rad(const ToldMotion& told, double span_s) {
  const double displacement_m = told.displacement_then_m.norm();
  return displacement_m < kSlowest_m_s * span_s ? kNoDirection_rad
                                                : kVelocity_m_s * span_s / displacement_m;
}

double rotationSigma_rad(const ImageMotion& seen, const ToldMotion& told) {
  const double rotation_rad =
      std::max(rotationVectorOf(told.R_then_now).norm(), rotationVectorOf(seen.R_then_now).norm());
  return kAttitude_rad + kOfRotation * rotation_rad;
}

DisplacementGuess guessFrom(const ToldMotion& told, double span_s) {
  DisplacementGuess guess;
  guess.displacement_m = told.displacement_then_m;
  const double displacement_m = told.displacement_then_m.norm();
  guess.sigma_m = displacement_m < kSlowest_m_s * span_s
                      ? kAnywhere_m
                      : kVelocity_m_s * span_s + kOfRotation * displacement_m;
  return guess;
}

/// From all sides, without regard to what is told.
void addFitsFromAllSides(const std::vector<BearingPair>& pairs, double corner_sigma_rad,
                         std::vector<ImageMotion>& fits) {
  static const std::array<Eigen::Vector3d, 7> kDirections{
      Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0),  Eigen::Vector3d(0, 0, 1),
      Eigen::Vector3d(1, 0, 1), Eigen::Vector3d(-1, 0, 1), Eigen::Vector3d(0, 1, 1),
      Eigen::Vector3d(0, -1, 1)};
  for (const Eigen::Vector3d& direction : kDirections)
    if (const auto fit = fitMotion(pairs, corner_sigma_rad, {direction, kAnywhere_m}))
      fits.push_back(*fit);
}

}  // namespace

double squaresBetween(const ImageMotion& seen, const ToldMotion& told, double span_s) {
  const double rotation_sigma_rad = rotationSigma_rad(seen, told);
  const double direction_sigma_rad = directionSigma_rad(told, span_s);
  Vector5d variance;
  variance.head<3>().setConstant(rotation_sigma_rad * rotation_sigma_rad);
  variance.tail<2>().setConstant(kDirection_rad * kDirection_rad +
                                 direction_sigma_rad * direction_sigma_rad);

  Vector5d off;
  off.head<3>() = rotationVectorOf(seen.R_then_now * told.R_then_now.transpose());
  const Eigen::Vector3d direction =
      told.displacement_then_m / std::max(told.displacement_then_m.norm(), 1e-9);
  const double angle_rad = portable::atan2(seen.direction_then.cross(direction).norm(),
                                           seen.direction_then.dot(direction));
  const Eigen::Vector2d across = tangentsOf(seen.direction_then).transpose() * direction;
  // Of the opposite direction all tangents are alike.
  off.tail<2>() = across.norm() > 1e-9 ? Eigen::Vector2d(across.normalized() * angle_rad)
                                       : Eigen::Vector2d(angle_rad, 0);
  // As (information^-1 + variance)^-1 where some directions have no information.
  const Matrix5d softened = Matrix5d::Identity() + seen.information * variance.asDiagonal();
  const double squares = off.dot(softened.inverse() * seen.information * off);
  return std::isfinite(squares) ? std::clamp(squares, 0.0, kMostSquares) : kMostSquares;
}

std::optional<ImageMotion> motionSeen(const std::vector<BearingPair>& pairs,
                                      double corner_sigma_rad, const ToldMotion& told,
                                      double span_s) {
  const auto count = static_cast<double>(pairs.size());
  const auto first = fitMotion(pairs, corner_sigma_rad, guessFrom(told, span_s));
  if (first && squaresBetween(*first, told, span_s) <= kAgrees &&
      first->cost <= kFewOutliers * count)
    return first;
  std::vector<ImageMotion> fits;
  if (first) fits.push_back(*first);
  addFitsFromAllSides(pairs, corner_sigma_rad, fits);
  double least = kMostOutliers * count;
  for (const ImageMotion& fit : fits) least = std::min(least, fit.cost);
  std::optional<ImageMotion> nearest;
  double nearest_squares = std::numeric_limits<double>::infinity();
  for (const ImageMotion& fit : fits) {
    const double squares = squaresBetween(fit, told, span_s);
    if (fit.cost > least + kAsGood * count || squares >= nearest_squares) continue;
    nearest = fit;
    nearest_squares = squares;
  }
  return nearest;
}

double squaresTold(const std::vector<BearingPair>& pairs, double corner_sigma_rad,
                   const ImageMotion& seen, const ToldMotion& told, double span_s) {
  const double squares = squaresBetween(seen, told, span_s);
  const double direction_sigma_rad = directionSigma_rad(told, span_s);
  // Of any way the tracks make one that turns the image as well.
  if (squares <= kUsual || direction_sigma_rad >= kNoDirection_rad) return squares;
  KnownMotion known;
  known.R_then_now = told.R_then_now;
  known.rotation_sigma_rad = rotationSigma_rad(seen, told);
  const double displacement_m = told.displacement_then_m.norm();
  known.displacement.displacement_m = told.displacement_then_m;
  known.displacement.sigma_m =
      displacement_m * portable::hypot(kDirection_rad, direction_sigma_rad);
  return std::min(squares, squaresAgainst(known, seen, pairs, corner_sigma_rad));
}

SeenYaw seenYaw(const ComparedMotion& motion, const Eigen::Matrix3d& R_base_cam,
                std::int64_t stamp_ns) {
  const ToldMotion& told = motion.told();
  const Eigen::Vector3d up_cam = R_base_cam.row(2).transpose();
  const Eigen::Matrix3d R_off = motion.seen.R_then_now * told.R_then_now.transpose();
  const Eigen::Matrix3d covariance = motion.seen.information.inverse().topLeftCorner<3, 3>();
  const double of_rotation_rad = kOfRotation * rotationVectorOf(told.R_then_now).norm();
  const double variance_rad2 = up_cam.dot(covariance * up_cam) + of_rotation_rad * of_rotation_rad;
  if (!(variance_rad2 > 0) || !std::isfinite(variance_rad2)) return {};
  return {stamp_ns, motion.span_s, told.displacement_then_m.norm(),
          up_cam.dot(rotationVectorOf(R_off)), variance_rad2};
}

std::optional<ImageMotion> motionAtFactor(std::vector<BearingPair>& pairs, double corner_sigma_rad,
                                          const ToldMotion& told, double span_s, double factor) {
  for (BearingPair& pair : pairs) {
    for (Eigen::Vector3d* ray : {&pair.then, &pair.now}) {
      ray->head<2>() *= factor;
      ray->normalize();
    }
  }
  return fitMotion(pairs, factor * corner_sigma_rad, guessFrom(told, span_s));
}

}  // namespace ardrone_vslam
