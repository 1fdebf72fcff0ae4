// SPDX-License-Identifier: BSD-3-Clause
// The flight, the sequence that it makes, and whether there is enough to see on it.
#include "world/world_sequence.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/features2d.hpp>
#include <stdexcept>

#include "simulation/random_source.hpp"
#include "support/shipped_profiles.hpp"
#include "world/scene/world_room.hpp"

namespace ardrone_vslam {
namespace {

WorldOptions shortFlight(double duration_s, double rate_hz) {
  WorldOptions options;
  options.duration_s = duration_s;
  options.rate_hz = rate_hz;
  return options;
}

bool sameBytes(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && cv::norm(a, b, cv::NORM_INF) == 0;
}

TEST(Flight, StartsAtRestWhereItIsTold) {
  for (const FlightStart& start :
       {FlightStart{0, 0, 0}, FlightStart{-2.5, 1.5, 3.0}, FlightStart{3.2, -2.2, -2.0}}) {
    const auto flight = makeFlight("laps", start);
    const Eigen::Isometry3d first = flight->pose(0), soon = flight->pose(0.05);
    EXPECT_NEAR(first.translation().x(), start.x_m, 1e-9);
    EXPECT_NEAR(first.translation().y(), start.y_m, 1e-9);
    EXPECT_TRUE(first.linear().isApprox(
        Eigen::AngleAxisd(start.yaw_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix(), 1e-5));
    EXPECT_LT((soon.translation() - first.translation()).norm(), 1e-4);
  }
}

/// Largest values along a flight, by differences of 10 ms.
struct Extremes {
  double speed_m_s = 0;
  double angular_rate_rad_s = 0;
  double angular_acceleration_rad_s2 = 0;
  double tilt_rad = 0;
  double least_wall_distance_m = 1e9;
};

Extremes fly(const Flight& flight, double seconds) {
  constexpr double kStep_s = 0.01;
  Extremes e;
  Eigen::Vector3d last_rotation = Eigen::Vector3d::Zero();
  for (double t = 0; t < seconds; t += kStep_s) {
    const Eigen::Isometry3d a = flight.pose(t), b = flight.pose(t + kStep_s);
    const Eigen::AngleAxisd turn(a.linear().transpose() * b.linear());
    const Eigen::Vector3d rate = turn.axis() * turn.angle() / kStep_s;
    const Eigen::Vector3d p = a.translation();
    e.speed_m_s = std::max(e.speed_m_s, (b.translation() - p).norm() / kStep_s);
    e.angular_rate_rad_s = std::max(e.angular_rate_rad_s, rate.norm());
    e.angular_acceleration_rad_s2 =
        std::max(e.angular_acceleration_rad_s2, (rate - last_rotation).norm() / kStep_s);
    e.tilt_rad = std::max(e.tilt_rad, std::acos(std::min(1.0, a.linear()(2, 2))));
    e.least_wall_distance_m =
        std::min({e.least_wall_distance_m, kRoomLength_m / 2 - std::abs(p.x()),
                  kRoomWidth_m / 2 - std::abs(p.y()), p.z(), kRoomHeight_m - p.z()});
    last_rotation = rate;
  }
  return e;
}

TEST(Flight, IsSmoothAndStaysInTheRoom) {
  const Extremes usual = fly(*makeFlight("laps", std::nullopt), 200);
  EXPECT_LT(usual.speed_m_s, 1.2);
  EXPECT_GT(usual.speed_m_s, 0.5);
  EXPECT_LT(usual.angular_rate_rad_s, 1.0);
  EXPECT_LT(usual.angular_acceleration_rad_s2, 3.0);
  EXPECT_LT(usual.tilt_rad, 0.1);
  EXPECT_GT(usual.tilt_rad, 0.02);
  EXPECT_GT(usual.least_wall_distance_m, 0.9);
  const Extremes from_corner = fly(*makeFlight("laps", FlightStart{3.4, -2.4, 0.3}), 20);
  EXPECT_LT(from_corner.speed_m_s, 2);
  EXPECT_LT(from_corner.angular_rate_rad_s, 2);
  EXPECT_GT(from_corner.least_wall_distance_m, 0.5);
}

TEST(Flight, LeansAsItsAccelerationAsks) {
  const auto flight = makeFlight("laps", std::nullopt);
  constexpr double kStep_s = 0.02, kDrag_per_s = 0.3;
  for (double t = 0.5; t < 40; t += 0.7) {
    const Eigen::Vector3d before = flight->pose(t - kStep_s).translation();
    const Eigen::Vector3d now = flight->pose(t).translation();
    const Eigen::Vector3d after = flight->pose(t + kStep_s).translation();
    const Eigen::Vector3d thrust = (after - 2 * now + before) / (kStep_s * kStep_s) +
                                   kDrag_per_s * (after - before) / (2 * kStep_s) +
                                   Eigen::Vector3d(0, 0, 9.81);
    EXPECT_LT(thrust.normalized().cross(flight->pose(t).linear().col(2)).norm(), 1e-3);
  }
}

TEST(Flight, ComesBackEachLap) {
  const auto flight = makeFlight("laps", std::nullopt);
  for (double t = 10; t < 100; t += 5) {
    EXPECT_LT((flight->pose(t + 17).translation() - flight->pose(t).translation()).norm(), 0.8);
  }
}

TEST(Flight, HoversWhereTheLapBegan) {
  const auto laps = makeFlight("laps", std::nullopt);
  const auto flight = makeFlight("laps_then_hover", std::nullopt);
  EXPECT_FALSE(hoverBegin_s("laps"));
  const double begin_s = hoverBegin_s("laps_then_hover").value();
  EXPECT_TRUE(flight->pose(10).isApprox(laps->pose(10), 1e-9));
  const Eigen::Isometry3d first = flight->pose(begin_s);
  EXPECT_LT((first.translation() - flight->pose(4).translation()).norm(), 1.5);
  double farthest_m = 0;
  double widest_rad = 0;
  for (double t = begin_s; t < begin_s + 60; t += 0.1) {
    const Eigen::Isometry3d moved = first.inverse() * flight->pose(t);
    farthest_m = std::max(farthest_m, moved.translation().norm());
    widest_rad = std::max(widest_rad, Eigen::AngleAxisd(moved.linear()).angle());
  }
  EXPECT_LT(farthest_m, 0.15);
  EXPECT_GT(farthest_m, 0.03);
  EXPECT_LT(widest_rad, 0.1);
  const Extremes extremes = fly(*flight, begin_s + 60);
  EXPECT_LT(extremes.speed_m_s, 1.2);
  EXPECT_LT(extremes.angular_acceleration_rad_s2, 3.0);
}

TEST(Flight, NamesWhatIsWrong) {
  EXPECT_THROW(makeFlight("loops", std::nullopt), std::invalid_argument);
  EXPECT_THROW(makeFlight("laps", FlightStart{3.6, 0, 0}), std::invalid_argument);
  EXPECT_THROW(makeFlight("laps", FlightStart{0, std::nan(""), 0}), std::invalid_argument);
  EXPECT_THROW(WorldSequence(shortFlight(0.01, 1)), std::invalid_argument);
}

TEST(WorldSequence, ImagesAndTruthBelongTogether) {
  WorldSequence world(shortFlight(8, 1));
  ASSERT_EQ(world.size(), 8U);
  const WorldRenderer renderer(world.camera());
  const Scene room = makeRoom(0);
  for (std::size_t i = 0; i < world.size(); ++i) {
    EXPECT_EQ(world.stamp_ns(i), 1000000000 * static_cast<std::int64_t>(i + 1));
    EXPECT_EQ(world.truth().poses()[i].stamp_ns, world.stamp_ns(i));
  }
  const Eigen::Isometry3d T_world_cam = world.truth().poses()[6].T_frame_body * world.T_base_cam();
  cv::Mat difference;
  cv::absdiff(world.image(6), renderer.render(room, T_world_cam, 99), difference);
  EXPECT_LT(cv::mean(difference)[0], 3);  // noise alone
}

TEST(WorldSequence, BaseIsWhereItIsAskedForAndTheCameraFliesAlike) {
  WorldOptions options = shortFlight(6, 2);
  WorldSequence drone(options);
  options.T_base_cam = forwardCamera();
  WorldSequence camera(options);
  const Eigen::Isometry3d T_drone_camera =
      drone.truth().poses()[9].T_frame_body.inverse() * camera.truth().poses()[9].T_frame_body;
  EXPECT_TRUE(T_drone_camera.isApprox(Eigen::Isometry3d(Eigen::Translation3d(0.21, 0, 0)), 1e-9));
  EXPECT_TRUE(sameBytes(drone.image(9), camera.image(9)));
}

TEST(WorldSequence, OdometryErrsAboutTheDronesAxesWhereverBaseLooks) {
  WorldOptions options = shortFlight(4, 1);
  options.odometry = test::shippedProfile("drone");
  options.T_body_cam = options.T_base_cam = cameraNamed("bottom").T_body_cam;
  const WorldSequence drone(options);
  options.T_base_cam = forwardCamera();  // base looks down
  const WorldSequence camera(options);
  const Eigen::Matrix3d R_body_base = (options.T_body_cam * options.T_base_cam.inverse()).linear();
  ASSERT_LT(R_body_base(2, 0), -0.9);
  ASSERT_EQ(camera.odometry().size(), drone.odometry().size());
  for (std::size_t i = 0; i < drone.odometry().size(); ++i) {
    const Eigen::Matrix3d expected = drone.odometry()[i].T_odom_base.linear() * R_body_base;
    ASSERT_TRUE(camera.odometry()[i].T_odom_base.linear().isApprox(expected, 1e-9)) << i;
  }
}

TEST(WorldSequence, SeedsDecide) {
  WorldOptions options = shortFlight(4, 1);
  options.odometry = test::shippedProfile("drone");
  options.seed = 3;
  WorldSequence world(options), again(options);
  options.seed = 4;
  WorldSequence other_noise(options);
  options.world_seed = 1;
  WorldSequence other_room(options);
  for (std::size_t i : {3, 0}) EXPECT_TRUE(sameBytes(world.image(i), again.image(i)));
  EXPECT_EQ(world.odometryNote().scale_error, again.odometryNote().scale_error);
  EXPECT_NE(world.odometryNote().scale_error, other_noise.odometryNote().scale_error);
  EXPECT_EQ(world.odometry().back().T_odom_base.matrix(),
            again.odometry().back().T_odom_base.matrix());
  EXPECT_FALSE(sameBytes(world.image(0), other_noise.image(0)));
  const double noise = cv::norm(world.image(0), other_noise.image(0), cv::NORM_L1);
  EXPECT_GT(cv::norm(world.image(0), other_room.image(0), cv::NORM_L1), 5 * noise);
}

TEST(WorldSequence, ThreadsDoNotMatter) {
  WorldSequence world(shortFlight(3, 1));
  const int threads = cv::getNumThreads();
  cv::setNumThreads(1);
  const cv::Mat alone = world.image(2);
  cv::setNumThreads(2);
  const cv::Mat together = world.image(2);
  cv::setNumThreads(threads);
  EXPECT_TRUE(sameBytes(alone, together));
}

TEST(WorldSequence, EveryFrameHasCornersAllOverTheImage) {
  for (std::uint64_t world_seed = 0; world_seed < 3; ++world_seed) {
    WorldOptions options = shortFlight(60, 1);
    options.world_seed = world_seed;
    WorldSequence world(options);
    for (std::size_t i = 0; i < world.size(); ++i) {
      std::vector<cv::KeyPoint> corners;
      cv::FAST(world.image(i), corners, 20);
      EXPECT_GE(corners.size(), 300U) << "room " << world_seed << ", frame " << i;
      std::array<int, 12> in_cell{};  // 4 x 3 cells of 160 x 120 pixels
      for (const auto& corner : corners) {
        ++in_cell[static_cast<std::size_t>(corner.pt.x / 160) +
                  4 * static_cast<std::size_t>(corner.pt.y / 120)];
      }
      EXPECT_GE(std::count_if(in_cell.begin(), in_cell.end(), [](int n) { return n >= 10; }), 8)
          << "room " << world_seed << ", frame " << i;
    }
  }
}

}  // namespace
}  // namespace ardrone_vslam
