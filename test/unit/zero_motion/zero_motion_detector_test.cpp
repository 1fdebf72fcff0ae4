// SPDX-License-Identifier: BSD-3-Clause
#include "zero_motion/zero_motion_detector.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "ardrone_vslam/rotation.hpp"
#include "simulation/random_source.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kFocalLength_px = 570;
constexpr double kRate_hz = 30;
constexpr double kAttitude_rad = 0.0037;  // of a turn between two images: 0.15 degrees each

/// A camera before points in view, 2 to 6 m away, filmed at 30 Hz.
class Film {
 public:
  explicit Film(int points = 150, double wrong_share = 0) : wrong_share_(wrong_share) {
    for (int i = 0; i < points; ++i) {
      const double depth_m = random_.uniform(2, 6);
      points_.emplace_back(depth_m * random_.uniform(-0.5, 0.5),
                           depth_m * random_.uniform(-0.3, 0.3), depth_m);
    }
  }

  /// The next image's verdict; the odometry's attitude has noise.
  CameraMotion see(ZeroMotionDetector& detector, const Eigen::Vector3d& position,
                   const Eigen::Matrix3d& R_world_cam = Eigen::Matrix3d::Identity()) {
    if (frame_ == 0) R_world_reference_ = R_world_cam;
    const Eigen::Matrix3d R_reference_now = R_world_reference_.transpose() * R_world_cam *
                                            rotationOf(kAttitude_rad * random_.normal3());
    const CameraMotion motion =
        detector.see(imageFrom(position, R_world_cam), {R_reference_now, kAttitude_rad});
    if (detector.isReference()) R_world_reference_ = R_world_cam;
    return motion;
  }

 private:
  ImageFeatures imageFrom(const Eigen::Vector3d& position, const Eigen::Matrix3d& R_world_cam) {
    ImageFeatures features;
    features.stamp_ns = std::llround(frame_++ * 1e9 / kRate_hz);
    features.focal_length_px = kFocalLength_px;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Eigen::Vector3d p = R_world_cam.transpose() * (points_[i] - position);
      if (p.z() < 0.1 || std::abs(p.x()) > 0.56 * p.z()) continue;
      Eigen::Vector3d ray(p.x() / p.z(), p.y() / p.z(), 1);
      for (int k = 0; k < 2; ++k) ray[k] += 0.5 * random_.normal() / kFocalLength_px;
      if (random_.chance(wrong_share_)) {
        for (int k = 0; k < 2; ++k) ray[k] += random_.uniform(-40, 40) / kFocalLength_px;
      }
      features.pixel_px.emplace_back(0.F, 0.F);
      features.bearing_cam.push_back(ray.normalized().cast<float>());
      features.track_id.push_back(static_cast<std::uint32_t>(i + 1));
      features.descriptor.emplace_back();
    }
    return features;
  }

  double wrong_share_;
  RandomSource random_{7};
  std::vector<Eigen::Vector3d> points_;
  Eigen::Matrix3d R_world_reference_ = Eigen::Matrix3d::Identity();
  int frame_ = 0;
};

struct Counts {
  int resting = 0;
  int rotating = 0;
  int moving = 0;
};

/// Over `seconds`, without the first 1.5.
template <class PositionAt, class YawAt>
Counts watch(Film& film, ZeroMotionDetector& detector, double seconds,
             const PositionAt& position_at, const YawAt& yaw_at) {
  Counts counts;
  for (double t_s = 0; t_s < seconds; t_s += 1 / kRate_hz) {
    const CameraMotion motion =
        film.see(detector, position_at(t_s), rotationOf({0, yaw_at(t_s), 0}));
    if (t_s < 1.5) continue;
    counts.resting += motion == CameraMotion::kResting ? 1 : 0;
    counts.rotating += motion == CameraMotion::kRotating ? 1 : 0;
    counts.moving += motion == CameraMotion::kMoving ? 1 : 0;
  }
  return counts;
}

Eigen::Vector3d nowhere(double) {
  return Eigen::Vector3d::Zero();
}
double straightOn(double) {
  return 0;
}

TEST(ZeroMotionDetector, AStillCameraRestsAfterASecond) {
  // Wrong in one of two images: 0, 15 and 30 % of the tracks.
  for (const double wrong_share : {0.0, 0.08, 0.163}) {
    Film film(150, wrong_share);
    ZeroMotionDetector detector;
    EXPECT_NE(film.see(detector, Eigen::Vector3d::Zero()), CameraMotion::kResting);
    EXPECT_TRUE(detector.isReference());
    const Counts counts = watch(film, detector, 10, nowhere, straightOn);
    EXPECT_GT(counts.resting, 240) << wrong_share;
    EXPECT_EQ(counts.moving + counts.rotating, 0) << wrong_share;
    EXPECT_GT(detector.still_s(), 9) << wrong_share;
  }
}

TEST(ZeroMotionDetector, WhatItHidesIsAPixelAcrossAndMoreAlongTheView) {
  Film film;
  ZeroMotionDetector detector;
  watch(film, detector, 3, nowhere, straightOn);
  const Eigen::Vector3d hidden_px =
      detector.stillness().hidden.diagonal().cwiseSqrt() * kFocalLength_px;
  EXPECT_LT(hidden_px.x(), 1);
  EXPECT_LT(hidden_px.y(), 1);
  EXPECT_GT(hidden_px.z(), hidden_px.x());
  EXPECT_LT(hidden_px.z(), 3);
}

TEST(ZeroMotionDetector, TurningOnTheSpotIsRotating) {
  Film film(600);
  ZeroMotionDetector detector;
  const Counts counts =
      watch(film, detector, 4, nowhere, [](double t_s) { return 0.1 * (t_s - 2); });
  EXPECT_GT(counts.rotating, 60);
  EXPECT_EQ(counts.moving + counts.resting, 0);
  // What a small turn may stand for is no longer hidden by the pixel noise alone.
  EXPECT_GT(std::sqrt(detector.stillness().hidden(0, 0)) * kFocalLength_px, 1);
}

TEST(ZeroMotionDetector, CreepingIsSeenBeforeItHasGoneFar) {
  struct Case {
    Eigen::Vector3d velocity_m_s;
    double hidden_m;
  };
  for (const Case& c :
       {Case{{0.01, 0, 0}, 0.1}, Case{{0, 0.01, 0}, 0.1}, Case{{0, 0, 0.01}, 0.1}}) {
    Film film;
    ZeroMotionDetector detector;
    double reference_t_s = 0;
    double farthest_m = 0;
    for (double t_s = 0; t_s < 30; t_s += 1 / kRate_hz) {
      film.see(detector, c.velocity_m_s * t_s);
      if (detector.isReference()) reference_t_s = t_s;
      farthest_m = std::max(farthest_m, (t_s - reference_t_s) * c.velocity_m_s.norm());
    }
    EXPECT_LT(farthest_m, c.hidden_m) << c.velocity_m_s.transpose();
  }
}

TEST(ZeroMotionDetector, AFlyingCameraIsNeverAtRest) {
  const std::vector<Eigen::Vector3d> velocities_m_s{
      {0.3, 0, 0}, {0, 0.3, 0}, {0, 0, 0.3}, {0.1, 0.1, 0.1}, {0, 0, -0.15}};
  for (const Eigen::Vector3d& velocity_m_s : velocities_m_s) {
    Film film(400);
    ZeroMotionDetector detector;
    const Counts counts = watch(
        film, detector, 4, [&](double t_s) -> Eigen::Vector3d { return velocity_m_s * (t_s - 2); },
        straightOn);
    EXPECT_EQ(counts.resting + counts.rotating, 0) << velocity_m_s.transpose();
    EXPECT_GT(counts.moving, 0) << velocity_m_s.transpose();
  }
}

TEST(ZeroMotionDetector, ATurnThatTheOdometryDoesNotSeeIsMotion) {
  // Sideways past a wall looks like a turn.
  Film film(600);
  ZeroMotionDetector detector;
  for (double t_s = 0; t_s < 2; t_s += 1 / kRate_hz) film.see(detector, Eigen::Vector3d::Zero());
  CameraMotion motion = CameraMotion::kUnknown;
  for (double t_s = 0; t_s < 0.5 && motion != CameraMotion::kMoving; t_s += 1 / kRate_hz)
    motion = film.see(detector, {0.4 * t_s, 0, 0});
  EXPECT_EQ(motion, CameraMotion::kMoving);
}

TEST(ZeroMotionDetector, FewTracksSayNothing) {
  Film film(10);
  ZeroMotionDetector detector;
  const Counts counts = watch(film, detector, 3, nowhere, straightOn);
  EXPECT_EQ(counts.resting + counts.rotating + counts.moving, 0);
}

TEST(ZeroMotionDetector, OneBadImageDoesNotEndIt) {
  Film film;
  ZeroMotionDetector detector;
  watch(film, detector, 2, nowhere, straightOn);
  EXPECT_EQ(film.see(detector, {0.5, 0, 0}), CameraMotion::kUnknown);
  EXPECT_FALSE(detector.isReference());
  EXPECT_EQ(film.see(detector, Eigen::Vector3d::Zero()), CameraMotion::kResting);
}

}  // namespace
}  // namespace ardrone_vslam
