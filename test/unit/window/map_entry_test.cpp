// SPDX-License-Identifier: BSD-3-Clause
#include "window/map_entry.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "ardrone_vslam/rotation.hpp"
#include "support/eigenvalues.hpp"
#include "support/odometry_window.hpp"

namespace ardrone_vslam {
namespace {

constexpr int kFrames = 6;

OdometryWindow flight() {
  OdometryWindow window;
  for (int i = 0; i < kFrames; ++i) {
    OdometryState state;
    state.stamp_ns = 1'000'000'000LL * i;
    state.T_odom_base.translation() << 0.4 * i, 0.1 * i * i, 1;
    state.T_odom_base.linear() = rotationOf({0.02, -0.01, 0.1 * i});
    window.add(state);
  }
  window.makeAnchor(0);
  return window;
}

LoadedAnchors twoAnchors() {
  LoadedAnchors loaded;
  for (int i = 0; i < 2; ++i) {
    Clone anchor;
    anchor.id = 4'000'000'000U - static_cast<std::uint32_t>(i);
    anchor.position_map << 5.0 + i, -2, 1;
    anchor.is_loaded = true;
    loaded.anchors.push_back(anchor);
  }
  Eigen::MatrixXd root = Eigen::MatrixXd::Zero(14, 14);
  for (int r = 0; r < 14; ++r)
    for (int c = 0; c <= r; ++c) root(r, c) = 0.01 * (((7 * r + 3 * c) % 5) + 1) / (1 + r - c);
  loaded.covariance = root * root.transpose();
  return loaded;
}

MapEntry someEntry(const WindowState& state) {
  MapEntry entry;
  entry.T_loaded_flight =
      Eigen::Translation3d(4, -1, 0.5) * Eigen::AngleAxisd(2.2, Eigen::Vector3d::UnitZ());
  entry.camera_loaded = entry.T_loaded_flight * state.newest().position_map;
  entry.anchor = 1;
  entry.covariance = Eigen::Vector4d(0.01, 0.02, 0.005, 0.001).asDiagonal();
  return entry;
}

TEST(MapEntry, MovesPosesAndKeepsWhatTheyKnowOfEachOther) {
  OdometryWindow window = flight();
  const WindowState before = window;
  const MapEntry entry = someEntry(window);
  MapEntrance(window).enter(entry, twoAnchors());
  const Eigen::Matrix3d R = entry.T_loaded_flight.linear();
  ASSERT_EQ(window.anchors().size(), 3U);
  ASSERT_EQ(window.frames().size(), before.frames().size());
  for (std::size_t i = 0; i < window.frames().size(); ++i) {
    const Clone& moved = window.frames()[i];
    const Clone& then = before.frames()[i];
    EXPECT_LT((moved.position_map - entry.T_loaded_flight * then.position_map).norm(), 1e-12);
    EXPECT_LT((moved.R_map_rig - R * then.R_map_rig).norm(), 1e-12);
  }
  // The heading's error turns the way between two frames; beside that it is known as before.
  const int a = window.frameCoordinate(1);
  const int b = window.frameCoordinate(4);
  const Eigen::Matrix3d expected =
      R *
      before.relativeCovariance(before.frameCoordinate(1), before.frameCoordinate(4))
          .topLeftCorner<3, 3>() *
      R.transpose();
  const Eigen::Vector3d lever = Eigen::Vector3d::UnitZ().cross(window.frames()[1].position_map -
                                                               window.frames()[4].position_map);
  const double heading_rad2 = entry.covariance(3, 3) + twoAnchors().covariance(7 + 5, 7 + 5);
  EXPECT_LT((window.relativeCovariance(a, b).topLeftCorner<3, 3>() - expected -
             heading_rad2 * lever * lever.transpose())
                .norm(),
            1e-12);
}

TEST(MapEntry, TheFlightErrsWithTheAnchorThatItWasFoundBy) {
  OdometryWindow window = flight();
  const WindowState before = window;
  MapEntry entry = someEntry(window);
  const LoadedAnchors loaded = twoAnchors();
  MapEntrance(window).enter(entry, loaded);
  const Eigen::MatrixXd P = window.covariance();
  EXPECT_LT((P - P.transpose()).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_GT(test::leastEigenvalue(P), -1e-12);
  // As well as the anchor, and no better: relative to it the position has the entry's own error.
  const int newest = window.frameCoordinate(window.frames().size() - 1);
  const int anchor = window.anchorCoordinate(1);
  EXPECT_GT(P.diagonal().segment<3>(newest).sum(), P.diagonal().segment<3>(anchor).sum());
  // With exact anchors what is left is the entry's and the flight's own.
  OdometryWindow exact = flight();
  LoadedAnchors known = loaded;
  known.covariance.setZero();
  MapEntrance(exact).enter(entry, known);
  const int at = exact.frameCoordinate(exact.frames().size() - 1);
  const int was = before.frameCoordinate(before.frames().size() - 1);
  const Eigen::Matrix3d R = entry.T_loaded_flight.linear();
  const Eigen::Matrix3d own =
      R * Eigen::Matrix3d(before.covariance().block<3, 3>(was, was)) * R.transpose();
  EXPECT_LT((exact.covariance().block<3, 3>(at, at) - own - entry.covariance.topLeftCorner<3, 3>())
                .norm(),
            1e-12);
}

/// The flight with an anchor at its beginning, whose newest frame has been found elsewhere.
Revisit someRevisit(const WindowState& state, std::int64_t from_ns, std::int64_t to_ns) {
  Revisit revisit;
  revisit.entry = someEntry(state);
  revisit.anchor_id = state.anchors()[0].id;
  revisit.from_ns = from_ns;
  revisit.to_ns = to_ns;
  return revisit;
}

/// Covariance of the newest pose's position and heading beside what the anchor's error moves them
/// by, about the place where the camera was.
Eigen::Matrix4d besideAnchor(const WindowState& state, const Eigen::Vector3d& camera_map) {
  const int newest = state.frameCoordinate(state.frames().size() - 1);
  const int anchor = state.anchorCoordinate(0);
  Eigen::MatrixXd D = Eigen::MatrixXd::Zero(4, state.covariance().rows());
  const auto add = [&](const Clone& pose, int at, int count, double sign) {
    const PoseByAnchor J = poseByAnchor(camera_map - pose.position_map);
    D.block(0, at, 3, count) = sign * J.topLeftCorner(3, count);
    D.block(3, at, 1, count) = sign * J.block(5, 0, 1, count);
    D.block<3, 1>(0, WindowState::kScale) += sign * J.topRightCorner<3, 1>();
  };
  add(state.anchors()[0], anchor, WindowState::kAnchor, -1);
  add(state.newest(), newest, WindowState::kFrame, 1);
  return D * state.covariance() * D.transpose();
}

TEST(MapEntry, WhatCameSinceItWasLostMovesAlike) {
  OdometryWindow window = flight();
  const WindowState before = window;
  const std::int64_t lost_ns = before.frames()[2].stamp_ns;
  const Revisit revisit = someRevisit(window, lost_ns, lost_ns);
  MapEntrance(window).shift(revisit);
  const Eigen::Matrix3d R = revisit.entry.T_loaded_flight.linear();
  EXPECT_EQ(window.anchors()[0].position_map, before.anchors()[0].position_map);
  for (std::size_t i = 0; i < window.frames().size(); ++i) {
    const Eigen::Vector3d was = before.frames()[i].position_map;
    const Eigen::Vector3d is = i < 2 ? was : revisit.entry.T_loaded_flight * was;
    EXPECT_LT((window.frames()[i].position_map - is).norm(), 1e-12) << i;
  }
  EXPECT_LT((window.newest().R_map_rig - R * before.newest().R_map_rig).norm(), 1e-12);
  EXPECT_LT((window.R_map_odom() - R * before.R_map_odom() * R.transpose()).norm(), 1e-12);

  const Eigen::MatrixXd P = window.covariance();
  EXPECT_LT((P - P.transpose()).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_GT(test::leastEigenvalue(P), -1e-12);
  // What was before is known as before; the newest is known as well as the revisit says.
  const int others = window.frameCoordinate(2) - window.anchorCoordinate(0);
  const int first = window.anchorCoordinate(0);
  EXPECT_LT((P.block(first, first, others, others) -
             Eigen::MatrixXd(before.covariance()).block(first, first, others, others))
                .norm(),
            1e-12);
  EXPECT_LT((besideAnchor(window, revisit.entry.camera_loaded) - revisit.entry.covariance).norm(),
            1e-12);
}

TEST(MapEntry, ALoopIsSpreadOverTheTimeSinceThePlaceWasSeen) {
  OdometryWindow window = flight();
  const WindowState before = window;
  const Revisit revisit =
      someRevisit(window, before.frames()[1].stamp_ns, before.newest().stamp_ns);
  MapEntrance(window).shift(revisit);
  for (std::size_t i = 0; i < window.frames().size(); ++i) {
    const Eigen::Vector3d was = before.frames()[i].position_map;
    const double share = i < 1 ? 0 : static_cast<double>(i - 1) / (kFrames - 3);
    const Eigen::Vector3d whole = revisit.entry.T_loaded_flight * was - was;
    EXPECT_LT((window.frames()[i].position_map - was - share * whole).norm(), 1e-12) << i;
  }
  EXPECT_GT(test::leastEigenvalue(window.covariance()), -1e-12);
  EXPECT_LT((besideAnchor(window, revisit.entry.camera_loaded) - revisit.entry.covariance).norm(),
            1e-12);
  // Between the two it is known less well: about as the whole is moved.
  const double whole_m = (window.newest().position_map - before.newest().position_map).norm();
  const int between = window.frameCoordinate(2);
  EXPECT_GT(std::sqrt(window.covariance()(between, between)), 0.1 * whole_m);
  EXPECT_LT(std::sqrt(window.covariance()(between, between)), whole_m);
}

/// What the derivative says is what a pose does that keeps its place among the anchor's landmarks.
TEST(MapEntry, APoseMovesWithItsAnchor) {
  const Eigen::Vector3d from_anchor(1, -2, 0.5);
  const double step = 1e-6;
  const PoseByAnchor J = poseByAnchor(from_anchor);
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d turn = step * Eigen::Vector3d::Unit(axis);
    const Eigen::Vector3d moved = rotationOf(turn) * from_anchor - from_anchor;
    EXPECT_LT((moved / step - J.block<3, 1>(0, 3 + axis)).norm(), 1e-5);
    EXPECT_EQ(J(3 + axis, 3 + axis), 1);
  }
  // Distances that are too long by a share: the true place is nearer to the anchor.
  EXPECT_TRUE((J.topRightCorner<3, 1>()).isApprox(-from_anchor));
}

/// From the third frame on.
TEST(MapEntrance, WhatIsDoubtedErrsAsOnePiece) {
  OdometryWindow window = flight();
  const WindowState before = window;
  Matrix6d more = Matrix6d::Zero();
  more.diagonal() << 0.04, 0.09, 0.01, 1e-4, 2e-4, 4e-4;
  const std::int64_t since_ns = 3'000'000'000;
  MapEntrance(window).doubtSince(since_ns, more);

  const auto& frames = window.frames();
  const int newest = window.frameCoordinate(frames.size() - 1);
  const auto P = window.covariance();
  EXPECT_TRUE(P.isApprox(P.transpose(), 1e-12));
  EXPECT_GT(test::leastEigenvalue(P), -1e-12);
  EXPECT_LT((P.block<6, 6>(newest, newest) - before.covariance().block<6, 6>(newest, newest) - more)
                .norm(),
            1e-12);
  EXPECT_LT((P.block<3, 3>(WindowState::kAttitude, WindowState::kAttitude) -
             before.covariance().block<3, 3>(WindowState::kAttitude, WindowState::kAttitude) -
             more.bottomRightCorner<3, 3>())
                .norm(),
            1e-12)
      << "the odometry goes on with the heading that is doubted";
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const int at = window.frameCoordinate(i);
    if (frames[i].stamp_ns < since_ns) {
      EXPECT_EQ((P.block<6, 6>(at, at)), (before.covariance().block<6, 6>(at, at))) << i;
      continue;
    }
    // Turned about the newest one, it moves by its lever.
    Eigen::Matrix<double, 3, 6> lever;
    lever << Eigen::Matrix3d::Identity(),
        -skew(frames[i].position_map - window.newest().position_map);
    EXPECT_LT((P.block<3, 3>(at, at) - before.covariance().block<3, 3>(at, at) -
               lever * more * lever.transpose())
                  .norm(),
              1e-12)
        << i;
    const Matrix6d change =
        window.relativeCovariance(newest, at) - before.relativeCovariance(newest, at);
    EXPECT_LT((change.bottomRightCorner<3, 3>().norm()), 1e-12)
        << "what is known of the turn between them stays, " << i;
  }
}

}  // namespace
}  // namespace ardrone_vslam
