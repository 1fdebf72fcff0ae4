// SPDX-License-Identifier: BSD-3-Clause
// Two cameras on one drone, of which one sees at a time: errors against the truth.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <array>
#include <functional>

#include "support/point_flight.hpp"

namespace ardrone_vslam {
namespace {

using test::Flight;
using test::FlightRun;
using test::PointWorld;

using test::kLapFrames;
constexpr int kLaps = 3;

/// As on the AR.Drone: one ahead, at the nose, one that looks down.
Eigen::Isometry3d frontExtrinsics() {
  return Eigen::Translation3d(0.21, 0, 0) * test::forwardExtrinsics();
}
/// Walls and floor.
PointWorld room(std::uint64_t seed) {
  PointWorld world = test::pointRoom(seed);
  RandomSource random(seed, 5);
  for (int i = 0; i < 3000; ++i) world.addPoint({random.uniform(-5, 5), random.uniform(-4, 4), 0});
  return world;
}

using WhichCamera = std::function<bool(std::size_t)>;  // of a frame: whether it is the bottom one
using Turns = std::array<Eigen::Matrix3f, 2>;          // of what the front and the bottom one see

struct SwitchedRun : FlightRun {
  std::vector<bool> is_bottom;
};

SwitchedRun fly(std::uint64_t seed, const Flight& flight,
                const std::vector<OdometryState>& odometry, const SlamConfig& config,
                const WhichCamera& is_bottom,
                const Turns& turns = {Eigen::Matrix3f::Identity(), Eigen::Matrix3f::Identity()}) {
  PointWorld world = room(seed);
  bool was_bottom = is_bottom(0);
  Slam slam(config, was_bottom ? test::bottomExtrinsics() : frontExtrinsics());
  SwitchedRun run;
  for (std::size_t i = 0; i < flight.size(); ++i) {
    const bool bottom = is_bottom(i);
    const Eigen::Isometry3d T_base_cam = bottom ? test::bottomExtrinsics() : frontExtrinsics();
    if (bottom != was_bottom) {
      slam.changeCamera(T_base_cam);
      world.changeCamera();
    }
    was_bottom = bottom;
    run.is_bottom.push_back(bottom);
    ImageFeatures seen = world.look(flight[i].T_map_base * T_base_cam, flight[i].stamp_ns);
    for (Eigen::Vector3f& bearing : seen.bearing_cam) bearing = turns[bottom ? 1 : 0] * bearing;
    run.results.push_back(slam.process(seen, odometry[i]));
  }
  run.landmarks = slam.landmarks();
  return run;
}

/// Of the frames from `first` on.
double rmse_m(const Flight& flight, const SwitchedRun& run, std::size_t first) {
  double sum = 0;
  for (std::size_t i = first; i < flight.size(); ++i)
    sum += (run.results[i].T_map_base.translation() - flight[i].T_map_base.translation())
               .squaredNorm();
  return std::sqrt(sum / static_cast<double>(flight.size() - first));
}

double odometryRmse_m(const Flight& flight, const std::vector<OdometryState>& odometry,
                      std::size_t first) {
  double sum = 0;
  for (std::size_t i = first; i < flight.size(); ++i)
    sum +=
        (odometry[i].T_odom_base.translation() - flight[i].T_map_base.translation()).squaredNorm();
  return std::sqrt(sum / static_cast<double>(flight.size() - first));
}

bool inSecondLap(std::size_t frame) {
  return frame >= kLapFrames && frame < 2 * kLapFrames;
}

TEST(CameraSwitch, OneMapHasWhatBothCamerasSaw) {
  const Flight flight = test::lapsFlight(kLapFrames, kLaps, 10);
  for (const bool thesis : {false, true}) {
    SlamConfig config = test::configForDrift();
    if (thesis) config.estimator = EstimatorKind::kThesis;
    const SwitchedRun run = fly(1, flight, test::observeExactly(flight), config, inSecondLap);
    int floor = 0;
    int walls = 0;
    for (const Landmark& landmark : run.landmarks) {
      const Eigen::Vector3d p = landmark.position_map;
      const double to_wall_m =
          std::min(std::abs(std::abs(p.x()) - 5), std::abs(std::abs(p.y()) - 4));
      if (std::abs(p.z()) < 0.1) ++floor;
      if (p.z() > 0.3 && to_wall_m < 0.3) ++walls;
    }
    EXPECT_GT(floor, 870) << thesis;  // measured: 1306, 1858
    EXPECT_GT(walls, 510) << thesis;  // measured: 764, 951
    EXPECT_GT(floor + walls, static_cast<int>(run.landmarks.size()) * 8 / 10) << thesis;
  }
}

TEST(CameraSwitch, WhatTheFirstCameraSawCorrectsThePoseWhenItIsBack) {
  const Flight flight = test::lapsFlight(kLapFrames, kLaps, 10);
  for (const std::uint64_t seed : {1, 2, 3}) {
    const auto odometry = test::observe(flight, {}, seed);
    const SwitchedRun run = fly(seed, flight, odometry, test::configForDrift(), inSecondLap);
    // The third lap finds the first one's landmarks.
    int localised = 0;
    for (std::size_t i = 2 * kLapFrames; i < flight.size(); ++i)
      localised += run.results[i].state == SlamState::kLocalised ? 1 : 0;
    EXPECT_GT(localised, kLapFrames * 9 / 10) << seed;  // measured: all
    EXPECT_LT(rmse_m(flight, run, 2 * kLapFrames),
              0.4 * odometryRmse_m(flight, odometry, 2 * kLapFrames))
        << seed;
  }
}

TEST(CameraSwitch, ThePoseDoesNotJumpWithTheCamera) {
  const Flight flight = test::lapsFlight(kLapFrames, 2, 10);
  const auto every_2_s = [](std::size_t frame) { return frame / 20 % 2 == 1; };
  const auto odometry = test::observeExactly(flight);
  const SwitchedRun run = fly(1, flight, odometry, test::configForDrift(), every_2_s);
  for (std::size_t i = 1; i < flight.size(); ++i) {
    const Eigen::Vector3d step =
        run.results[i].T_map_base.translation() - run.results[i - 1].T_map_base.translation();
    const Eigen::Vector3d truth =
        flight[i].T_map_base.translation() - flight[i - 1].T_map_base.translation();
    EXPECT_LT((step - truth).norm(), 0.016) << "frame " << i;  // measured: 0.0104
    EXPECT_GT(run.results[i].covariance.llt().matrixLLT().diagonal().minCoeff(), 0) << i;
  }
  EXPECT_LT(rmse_m(flight, run, 0), 0.009);  // measured: 0.006
}

TEST(CameraSwitch, TheLeverOfEachCameraIsItsOwn) {
  // Turning on the spot moves the camera at the nose, and the one below hardly.
  Flight flight;
  for (int i = 0; i < 240; ++i) {
    test::FlightPose pose;
    pose.stamp_ns = test::stampOf(i, 10);
    pose.T_map_base.linear() =
        Eigen::AngleAxisd(0.05 * i, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    pose.T_map_base.translation().z() = 1.2;
    flight.push_back(pose);
  }
  const auto every_2_s = [](std::size_t frame) { return frame / 20 % 2 == 1; };
  const SwitchedRun run =
      fly(1, flight, test::observeExactly(flight), test::configForDrift(), every_2_s);
  EXPECT_LT(rmse_m(flight, run, 0), 0.016);  // measured: 0.0105
}

TEST(CameraSwitch, EachCameraHasAnErrorOfItsOwnExtrinsics) {
  const Flight flight = test::lapsFlight(kLapFrames, kLaps, 10);
  const auto turned = [](float rad, const Eigen::Vector3f& axis) {
    return Eigen::AngleAxisf(rad, axis.normalized()).toRotationMatrix();
  };
  const Turns turns = {turned(0.02F, {1, 2, 3}), turned(0.02F, {-2, 1, -1})};
  double taken_for_exact_m = 0;
  double estimated_m = 0;
  for (const std::uint64_t seed : {1, 2, 3}) {
    const auto odometry = test::observe(flight, {}, seed);
    SlamConfig config = test::configForDrift();
    taken_for_exact_m += rmse_m(flight, fly(seed, flight, odometry, config, inSecondLap, turns), 0);
    config.msckf.odometry.extrinsics_sigma_deg = 1;
    const SwitchedRun run = fly(seed, flight, odometry, config, inSecondLap, turns);
    estimated_m += rmse_m(flight, run, 0);
    for (std::size_t i = 2 * kLapFrames; i < flight.size(); ++i)
      EXPECT_EQ(run.results[i].state, SlamState::kLocalised) << seed << " frame " << i;
  }
  // Measured: 0.64, as much as with one error for both; 0.84 were the second camera's taken for the
  // first one's.
  EXPECT_LT(estimated_m, 0.74 * taken_for_exact_m);
}

TEST(CameraSwitch, TheMapIsOfBothCamerasAlsoInALaterFlight) {
  const Flight flight = test::lapsFlight(kLapFrames, 2, 10);
  const auto odometry = test::observeExactly(flight);
  PointWorld world = room(1);
  const auto look = [&](std::size_t frame, const Eigen::Isometry3d& T_base_cam, int width_px) {
    ImageFeatures seen = world.look(flight[frame].T_map_base * T_base_cam, flight[frame].stamp_ns);
    seen.width_px = width_px;
    return seen;
  };
  Slam first(test::configForDrift(), frontExtrinsics());
  for (std::size_t i = 0; i < kLapFrames; ++i)
    first.process(look(i, frontExtrinsics(), 640), odometry[i]);
  first.changeCamera(test::bottomExtrinsics());
  world.changeCamera();
  first.process(look(kLapFrames, test::bottomExtrinsics(), 320), odometry[kLapFrames]);
  SavedMap map = first.save().map();
  ASSERT_EQ(map.cameras.size(), 2U);
  EXPECT_EQ(map.cameras[0].width_px, 640);
  EXPECT_EQ(map.cameras[1].width_px, 320);

  Slam second(test::configForDrift(), frontExtrinsics());
  second.load(std::move(map));
  std::size_t frame = kLapFrames + 20;
  do {
    second.process(look(frame, frontExtrinsics(), 640), odometry[frame]);
  } while (second.isSearching() && ++frame < flight.size());
  EXPECT_LT(frame, kLapFrames + 40);
  EXPECT_EQ(second.save().map().cameras.size(), 2U);
}

TEST(CameraSwitch, AnAbsurdMountingIsRefusedAndNothingChanges) {
  Slam slam(test::configForDrift(), frontExtrinsics());
  EXPECT_THROW(slam.changeCamera(Eigen::Translation3d(1000, 0, 0) * test::bottomExtrinsics()),
               std::invalid_argument);
}

}  // namespace
}  // namespace ardrone_vslam
