// SPDX-License-Identifier: BSD-3-Clause
#include "window/rays.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "support/track_views.hpp"

namespace ardrone_vslam {
namespace {

using test::bearingTo;
using test::kCamera_rig;
using test::poseAt;
using test::sidewaysWindow;
using test::viewOf;
using test::viewsOf;

TEST(RayResidual, JacobiansAreThoseOfSmallChanges) {
  const Clone pose = poseAt({1, 2, 3}, {0.1, 0.2, 0.3});
  const Eigen::Vector3d point(6, 3, 2.5);
  const Eigen::Vector3d bearing = bearingTo(point, pose);  // residual zero: first order is exact
  const auto at = rayResidual(pose, kCamera_rig, bearing, point);
  ASSERT_TRUE(at);
  EXPECT_LT(at->residual.norm(), 1e-12);
  constexpr double kStep = 1e-6;
  for (int k = 0; k < 9; ++k) {
    Eigen::Vector3d change = Eigen::Vector3d::Zero();
    change(k % 3) = kStep;
    // The estimate is wrong by -change, so the truth lies at +change of it.
    Clone wrong_pose = pose;
    Eigen::Vector3d wrong_point = point;
    if (k < 3) {
      wrong_pose.position_map -= change;
    } else if (k < 6) {
      wrong_pose.R_map_rig = rotationOf(-change) * pose.R_map_rig;
    } else {
      wrong_point -= change;
    }
    const auto moved = rayResidual(wrong_pose, kCamera_rig, bearing, wrong_point);
    ASSERT_TRUE(moved);
    const Eigen::Vector2d analytic =
        k < 6 ? Eigen::Vector2d(at->pose.col(k)) : Eigen::Vector2d(at->point.col(k - 6));
    EXPECT_LT((moved->residual / kStep - analytic).norm(), 1e-5) << "coordinate " << k;
  }
}

TEST(RayResidual, RefusesAPointBehindOrAtTheCamera) {
  const Clone pose = poseAt({0, 0, 0}, {0, 0, 0});
  EXPECT_FALSE(rayResidual(pose, kCamera_rig, {1, 0, 0}, {-3, 0, 0}));
  EXPECT_FALSE(rayResidual(pose, kCamera_rig, {1, 0, 0}, kCamera_rig));
}

TEST(TriangulateTrack, FindsThePointAndItsSigma) {
  const WindowState state = sidewaysWindow(8);
  const Eigen::Vector3d point(4, 0.5, 0.3);
  constexpr double kNoise_rad = 0.001;
  RandomSource random(1);
  double squared = 0;
  constexpr int kRuns = 200;
  for (int run = 0; run < kRuns; ++run) {
    const auto found = triangulateTrack(state.frames(), kCamera_rig,
                                        viewsOf(point, state, kNoise_rad, random, kNoise_rad));
    ASSERT_TRUE(found);
    const Eigen::Vector3d error = found->position_map - point;
    squared += error.dot(found->covariance_m2.inverse() * error);
    EXPECT_NEAR(found->parallax_rad, std::atan2(0.7, 4), 0.02);
  }
  EXPECT_NEAR(squared / kRuns, 3, 0.6);
}

TEST(RayRoot, IsOfTheInformationAlongColumnsAndRows) {
  Eigen::Matrix2d information;
  information << 9, 2, 2, 4;
  const RayRoot root = rayRoot(Eigen::Vector3d::UnitZ(), information);
  const Eigen::Matrix3d on_ray = root.transpose() * root;
  EXPECT_LT((on_ray.topLeftCorner<2, 2>() - information).norm(), 1e-12);
  EXPECT_LT(on_ray.col(2).norm(), 1e-12);
  const Eigen::Vector3d oblique = Eigen::Vector3d(0.5, -0.3, 1).normalized();
  const RayRoot same = rayRoot(oblique, Eigen::Matrix2d::Identity() / (0.01 * 0.01));
  const RayRoot alike = rayRoot(oblique, 0.01);
  EXPECT_LT((same.transpose() * same - alike.transpose() * alike).norm(), 1e-8);
}

TEST(RayResidual, OfAViewIsOfUnitNoise) {
  const Clone pose = poseAt({1, 2, 3}, {0.1, 0.2, 0.3});
  const Eigen::Vector3d point(6, 3, 2.5);
  const Eigen::Vector3d exact = bearingTo(point, pose);
  Eigen::Matrix2d information;  // ten times better along one axis
  information << 1e6, 0, 0, 1e4;
  const RayRoot root = rayRoot(exact, information);
  const Eigen::Matrix<double, 3, 2> from_unit =
      root.transpose() * (root * root.transpose()).inverse();
  RandomSource random(3);
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
  constexpr int kRuns = 4000;
  for (int i = 0; i < kRuns; ++i) {
    const Eigen::Vector2d unit(random.normal(), random.normal());
    const TrackView view{0, (exact + from_unit * unit).normalized(), root};
    const auto ray = rayResidual(pose, kCamera_rig, view, point);
    ASSERT_TRUE(ray);
    scatter += ray->residual * ray->residual.transpose() / kRuns;
  }
  EXPECT_LT((scatter - Eigen::Matrix2d::Identity()).norm(), 0.1) << scatter;
}

TEST(TriangulateTrack, WeighsRaysByWhatIsKnownOfThem) {
  const WindowState state = sidewaysWindow(8);
  const Eigen::Vector3d point(4, 0.5, 0.3);
  RandomSource random(7);
  double squared = 0;
  constexpr int kRuns = 300;
  for (int run = 0; run < kRuns; ++run) {
    std::vector<TrackView> views;
    for (std::size_t i = 0; i < state.frames().size(); ++i) {
      const double sigma_rad = i % 2 == 0 ? 0.0003 : 0.003;
      const Eigen::Vector3d exact = bearingTo(point, state.frames()[i]);
      views.push_back(viewOf(i, exact + sigma_rad * random.normal3(), sigma_rad));
    }
    const auto found = triangulateTrack(state.frames(), kCamera_rig, views);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->ray_sigma_rad, 0.00165, 1e-9);
    const Eigen::Vector3d error = found->position_map - point;
    squared += error.dot(found->covariance_m2.inverse() * error);
  }
  EXPECT_NEAR(squared / kRuns, 3, 0.6);
}

TEST(TriangulateTrack, HasNoPointForParallelOrSpreadingRays) {
  const WindowState state = sidewaysWindow(3);
  const std::vector<TrackView> parallel{viewOf(0, {1, 0, 0}), viewOf(2, {1, 0, 0})};
  const auto far = triangulateTrack(state.frames(), kCamera_rig, parallel);
  EXPECT_TRUE(!far || far->parallax_rad < 1e-3);
  const std::vector<TrackView> spreading{viewOf(0, {1, -0.1, 0}), viewOf(2, {1, 0.1, 0})};
  EXPECT_FALSE(triangulateTrack(state.frames(), kCamera_rig, spreading));
  const std::vector<TrackView> alone{viewOf(0, {1, 0, 0})};
  EXPECT_FALSE(triangulateTrack(state.frames(), kCamera_rig, alone));
}

}  // namespace
}  // namespace ardrone_vslam
