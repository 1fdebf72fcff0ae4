// SPDX-License-Identifier: BSD-3-Clause
#include "map_update/map_fix.hpp"

#include <gtest/gtest.h>

#include "ardrone_vslam/rotation.hpp"
#include "support/odometry_window.hpp"

namespace ardrone_vslam {
namespace {

const Eigen::Vector3d kCamera_rig(0.2, 0.05, -0.1);
constexpr double kAngleSigma_rad = 0.002;
constexpr int kAllIndependent = 1000;

/// Six frames of a curved way, two of them anchors with a stretch of their own.
WindowState curvedWindow() {
  OdometryWindow state;
  for (int i = 0; i < 6; ++i) {
    OdometryState odometry;
    odometry.stamp_ns = 100'000'000LL * i;
    odometry.T_odom_base.translation() << 0.3 * i, 0.05 * i * i, -0.04 * i;
    odometry.T_odom_base.linear() = rotationOf({0.02 * i, -0.03 * i, 0.1 * i});
    state.add(odometry);
  }
  state.makeAnchor(1);
  state.makeAnchor(1);
  return state;
}

/// Three landmarks of each anchor.
std::vector<MapObservation> landmarksOf(const WindowState& state) {
  std::vector<MapObservation> landmarks;
  const auto add = [&](std::size_t anchor, const Eigen::Vector3d& point_rig) {
    MapObservation s;
    s.anchor = anchor;
    s.point_map = state.frames().back().position_map + state.frames().back().R_map_rig * point_rig;
    s.covariance_m2 = Eigen::Vector3d(0.02, 0.001, 0.003).asDiagonal();
    landmarks.push_back(s);
  };
  for (const std::size_t anchor : {1U, 0U}) {
    const double depth_m = 3 + static_cast<double>(anchor);
    add(anchor, {depth_m, 1.2, 0.4});
    add(anchor, {depth_m + 1, -0.8, 0.7});
    add(anchor, {depth_m - 1, -0.3, -0.9});
  }
  return landmarks;
}

Clone moved(Clone pose, const Vector6d& error) {
  pose.position_map += error.head<3>();
  pose.R_map_rig = rotationOf(error.tail<3>()) * pose.R_map_rig;
  return pose;
}

/// The landmarks as the agreed pose sees them when the state errs by so much (WindowState's
/// coordinates), each carried along by its anchor.
ObservationConsensus seen(const WindowState& state, const Clone& agreed,
                          const Eigen::VectorXd& error) {
  const int newest = state.frameCoordinate(state.frames().size() - 1);
  const Clone camera = moved(agreed, error.segment<6>(newest));
  ObservationConsensus consensus{agreed.position_map, agreed.R_map_rig, landmarksOf(state)};
  for (MapObservation& s : consensus.observations) {
    const Clone& anchor = state.anchors()[s.anchor];
    const int at = state.anchorCoordinate(s.anchor);
    const double stretch = error(WindowState::kScale) + error(at + 6);
    const Eigen::Vector3d from_anchor = s.point_map - anchor.position_map;
    const Eigen::Vector3d truly =
        anchor.position_map + error.segment<3>(at) +
        (1 - stretch) * (rotationOf(error.segment<3>(at + 3)) * from_anchor);
    const Eigen::Vector3d offset = truly - camera.position_map - camera.R_map_rig * kCamera_rig;
    s.bearing_rig = (camera.R_map_rig.transpose() * offset).normalized();
  }
  return consensus;
}

/// Where nothing errs the information's vector is zero, and an error changes it by the
/// information's column of that error: by central differences of the rays themselves.
Eigen::VectorXd columnByDifferences(const WindowState& state, const Clone& agreed, int coordinate) {
  constexpr double kStep = 1e-5;
  const auto vectorOf = [&](double step) {
    Eigen::VectorXd error = Eigen::VectorXd::Zero(state.covariance().rows());
    error(coordinate) = step;
    return fixBy(state, kCamera_rig, seen(state, agreed, error), kAngleSigma_rad, kAllIndependent)
        .information.vector;
  };
  return (vectorOf(kStep) - vectorOf(-kStep)) / (2 * kStep);
}

Information exactly(const WindowState& state, const Clone& agreed) {
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(state.covariance().rows());
  return fixBy(state, kCamera_rig, seen(state, agreed, none), kAngleSigma_rad, kAllIndependent)
      .information;
}

TEST(MapFix, EveryColumnOfItsJacobianIsThatOfSmallChanges) {
  const WindowState state = curvedWindow();
  const Information information = exactly(state, state.frames().back());
  ASSERT_EQ(information.coordinates.size(), 1U + 6 + 2 * 7);
  for (std::size_t k = 0; k < information.coordinates.size(); ++k) {
    const Eigen::VectorXd column = information.matrix.col(static_cast<Eigen::Index>(k));
    const Eigen::VectorXd measured =
        columnByDifferences(state, state.frames().back(), information.coordinates[k]);
    ASSERT_GT(column.norm(), 1);
    EXPECT_LT((measured - column).norm(), 1e-6 * column.norm()) << "column " << k;
  }
}

/// Agreed 0.5 m beside the prediction: the columns of poses and anchors are those of the agreed
/// pose, and by way of its offset the vector speaks of the predicted one.
TEST(MapFix, ItsJacobianIsTakenWhereTheRaysAgree) {
  const WindowState state = curvedWindow();
  Vector6d offset;
  offset << 0.3, -0.4, 0.1, 0.02, -0.01, 0.03;
  const Clone agreed = moved(state.frames().back(), offset);
  const Information information = exactly(state, agreed);
  for (std::size_t k = 1; k < information.coordinates.size(); ++k) {
    const Eigen::VectorXd column = information.matrix.col(static_cast<Eigen::Index>(k));
    const Eigen::VectorXd measured = columnByDifferences(state, agreed, information.coordinates[k]);
    EXPECT_LT((measured - column).norm(), 1e-6 * column.norm()) << "column " << k;
  }
  const Eigen::VectorXd by_offset = information.matrix.middleCols<6>(1) * offset;
  EXPECT_LT((information.vector - by_offset).norm(), 1e-9 * by_offset.norm());
}

/// Map and window stretched alike look the same from the camera: whatever the distance between
/// prediction and agreement, a fix must not tell the scale.
TEST(MapFix, DoesNotSeeTheScale) {
  const WindowState state = curvedWindow();
  Vector6d offset = Vector6d::Zero();
  offset.head<3>() << 0.3, -0.4, 0.1;
  const Clone agreed = moved(state.frames().back(), offset);
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(state.covariance().rows());
  ObservationConsensus consensus = seen(state, agreed, none);
  const Eigen::Vector3d at_rig = Eigen::Vector3d::Zero();
  const Information information =
      fixBy(state, at_rig, consensus, kAngleSigma_rad, kAllIndependent).information;
  Eigen::VectorXd dilation = Eigen::VectorXd::Zero(information.matrix.cols());
  dilation(0) = 1;
  dilation.segment<3>(1) = -state.frames().back().position_map;
  for (std::size_t i = 0; i < 2; ++i)
    dilation.segment<3>(7 + 7 * static_cast<Eigen::Index>(i)) = -state.anchors()[i].position_map;
  EXPECT_LT((information.matrix * dilation).norm(), 1e-9 * information.matrix.norm());
}

}  // namespace
}  // namespace ardrone_vslam
