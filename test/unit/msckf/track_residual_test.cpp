// SPDX-License-Identifier: BSD-3-Clause
#include "msckf/track_residual.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "support/track_views.hpp"

namespace ardrone_vslam {
namespace {

using test::bearingTo;
using test::kCamera_rig;
using test::kSigma_rad;
using test::odometryOfFrame;
using test::sidewaysWindow;
using test::viewOf;
using test::viewsOf;

TEST(TrackResidual, DoesNotSeeTheScaleNorWhereTheMapIs) {
  const WindowState state = sidewaysWindow(6);
  RandomSource random(2);
  const auto views = viewsOf({3, 0.2, -0.4}, state, kSigma_rad, random);
  const auto point = triangulateTrack(state.frames(), Eigen::Vector3d::Zero(), views);
  ASSERT_TRUE(point);
  auto track = residualOf(state, Eigen::Vector3d::Zero(), views, *point);
  ASSERT_TRUE(track);
  for (ViewRows& rows : track->views) rows.residual.setZero();
  EXPECT_EQ(track->degreesOfFreedom(), 2 * 6 - 3);
  Eigen::VectorXd dilation = Eigen::VectorXd::Zero(6 * 6);
  Eigen::VectorXd shift = dilation;
  Eigen::VectorXd one_moved = dilation;
  one_moved.segment<3>(6 * 2) = Eigen::Vector3d(1, 2, 3);
  for (Eigen::Index i = 0; i < 6; ++i) {
    dilation.segment<3>(6 * i) = state.frames()[static_cast<std::size_t>(i)].position_map;
    shift.segment<3>(6 * i) = Eigen::Vector3d(1, 2, 3);
  }
  const int first = state.frameCoordinate(0);
  const auto change = [&](const Eigen::VectorXd& error) {
    return std::sqrt(track->squaredRest(error, first));
  };
  const double size = change(one_moved);
  EXPECT_GT(size, 1);
  EXPECT_LT(change(dilation), 1e-9 * size);
  EXPECT_LT(change(shift), 1e-9 * size);
}

/// The same by dense matrices and a basis of the rows that do not depend on the point.
TEST(TrackResidual, DistanceAndInformationAreThoseOfTheProjectedRows) {
  const WindowState state = sidewaysWindow(7);
  RandomSource random(4);
  auto views = viewsOf({3, 0.2, -0.4}, state, kSigma_rad, random);
  views.erase(views.begin() + 3);
  const auto point = triangulateTrack(state.frames(), kCamera_rig, views);
  ASSERT_TRUE(point);
  const auto track = residualOf(state, kCamera_rig, views, *point);
  ASSERT_TRUE(track);
  const int first = state.frameCoordinate(0);
  const int size = state.frameCoordinate(7) - first;
  const auto rows = static_cast<Eigen::Index>(2 * views.size());
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(rows, size);
  Eigen::VectorXd r(rows);
  Eigen::MatrixXd on_point(rows, 3);
  for (std::size_t i = 0; i < views.size(); ++i) {
    const auto ray =
        rayResidual(state.frames()[views[i].frame], kCamera_rig, views[i], point->position_map);
    ASSERT_TRUE(ray);
    const auto row = 2 * static_cast<Eigen::Index>(i);
    H.block<2, 6>(row, state.frameCoordinate(views[i].frame) - first) = ray->pose;
    r.segment<2>(row) = ray->residual;
    on_point.middleRows<2>(row) = ray->point;
  }
  const Eigen::MatrixXd Q = on_point.householderQr().householderQ();
  const Eigen::MatrixXd across = Q.rightCols(rows - 3).transpose();
  H = across * H;
  r = across * r;
  const Eigen::MatrixXd P = state.covariance().block(first, first, size, size);
  Eigen::MatrixXd S = H * P * H.transpose();
  S.diagonal().array() += 1;
  const double distance = r.dot(S.llt().solve(r));
  EXPECT_NEAR(track->distance(state), distance, 1e-9 * distance);

  Information information = Information::between(first, first + size);
  track->addTo(information, 0.5);
  const Eigen::MatrixXd expected = 0.5 * H.transpose() * H;
  const Eigen::MatrixXd whole = information.matrix.selfadjointView<Eigen::Lower>();
  EXPECT_LT((whole - expected).norm(), 1e-12 * expected.norm());
  EXPECT_LT((information.vector - 0.5 * H.transpose() * r).norm(),
            1e-12 * (H.transpose() * r).norm() + 1e-9);
  Eigen::VectorXd error(size);
  for (Eigen::Index i = 0; i < error.size(); ++i) error[i] = 0.01 * random.normal();
  EXPECT_NEAR(track->squaredRest(error, first), (r - H * error).squaredNorm(), 1e-9);
}

TEST(TrackResidual, ItsDistanceIsAChiSquareForHonestRays) {
  const WindowState state = sidewaysWindow(6);
  constexpr double kNoise_rad = 0.001;
  RandomSource random(3);
  // Rays from the frames as they are believed to be: only the rays' noise is left, so that the
  // distance with the frames' covariance in it is below its degrees of freedom and the bare one is
  // equal to them.
  double bare = 0;
  const Eigen::VectorXd no_error = Eigen::VectorXd::Zero(6 * 6);
  constexpr int kRuns = 200;
  int dof = 0;
  for (int run = 0; run < kRuns; ++run) {
    const auto views = viewsOf({3, 0.2, -0.4}, state, kNoise_rad, random, kNoise_rad);
    const auto point = triangulateTrack(state.frames(), kCamera_rig, views);
    ASSERT_TRUE(point);
    const auto track = residualOf(state, kCamera_rig, views, *point);
    ASSERT_TRUE(track);
    dof = track->degreesOfFreedom();
    const double squared = track->squaredRest(no_error, state.frameCoordinate(0));
    bare += squared;
    EXPECT_LE(track->distance(state), squared + 1e-9);
  }
  EXPECT_NEAR(bare / kRuns, dof, 0.15 * dof);
}

/// Looks down from 2 m, as does the flight's ground.
WindowState levelWindow(int frames) {
  OdometryWindow state;
  state.add(odometryOfFrame(0, {0, 0, 2}));
  for (int i = 1; i < frames; ++i) state.add(odometryOfFrame(i, {0.1 * i, 0.02 * i * i, 2}));
  return state;
}

TEST(TrackResidual, AHeightAddsOneRowThatSeesTheScale) {
  const WindowState state = levelWindow(5);
  constexpr double kSigma_m = 0.05;
  RandomSource random(4);
  const auto views = viewsOf({0.3, 0.2, 0}, state, 0, random);
  const auto point = triangulateTrack(state.frames(), kCamera_rig, views);
  ASSERT_TRUE(point);
  const auto bare = residualOf(state, kCamera_rig, views, *point);
  const auto floor = residualOf(state, kCamera_rig, views, *point, FloorHeight{2, kSigma_m});
  ASSERT_TRUE(bare && floor);
  EXPECT_EQ(floor->degreesOfFreedom(), bare->degreesOfFreedom() + 1);

  const int first = state.frameCoordinate(0);
  Eigen::VectorXd dilation = Eigen::VectorXd::Zero(6 * 5);  // about the first camera
  const Eigen::Vector3d camera = state.frames()[0].position_map + kCamera_rig;
  for (int i = 0; i < 5; ++i)
    dilation.segment<3>(6 * i) =
        state.frames()[static_cast<std::size_t>(i)].position_map + kCamera_rig - camera;
  const auto seen = [&](const TrackResidual& track) {
    Information information = Information::between(first, first + 6 * 5);
    track.addTo(information, 1);
    information.matrix.triangularView<Eigen::StrictlyUpper>() = information.matrix.transpose();
    return dilation.dot(information.matrix * dilation);
  };
  EXPECT_LT(seen(*bare), 1e-9);
  // The point is 2 m - 0.1 m below the camera, and its rays have noise, too.
  const double variance_m2 = kSigma_m * kSigma_m + point->covariance_m2(2, 2);
  EXPECT_NEAR(seen(*floor), 1.9 * 1.9 / variance_m2, 1);
}

TEST(TrackResidual, WithAHeightItsThreeFormsAgree) {
  const WindowState state = levelWindow(5);
  RandomSource random(6);
  const auto views = viewsOf({0.3, 0.2, 0}, state, kSigma_rad, random);
  const auto point = triangulateTrack(state.frames(), kCamera_rig, views);
  ASSERT_TRUE(point);
  const auto floor = residualOf(state, kCamera_rig, views, *point, FloorHeight{2.1, 0.05});
  ASSERT_TRUE(floor);
  // Stacked rows, projected.
  const int rows = 2 * static_cast<int>(floor->views.size());
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(rows, 6 * 5);
  Eigen::MatrixXd U(rows, 3);
  Eigen::VectorXd r(rows);
  const int first = state.frameCoordinate(0);
  for (int i = 0; i < rows / 2; ++i) {
    const ViewRows& view = floor->views[static_cast<std::size_t>(i)];
    A.block<2, 6>(2 * i, view.coordinate - first) = view.pose;
    U.block<2, 3>(2 * i, 0) = view.point;
    r.segment<2>(2 * i) = view.residual;
  }
  EXPECT_LT((U.transpose() * U - Eigen::Matrix3d::Identity()).norm(), 1e-12);
  EXPECT_LT((U.transpose() * r).norm(), 1e-9) << "the residual is projected";
  const Eigen::MatrixXd H = A - U * (U.transpose() * A);
  Information information = Information::between(first, first + 6 * 5);
  floor->addTo(information, 0.5);
  information.matrix.triangularView<Eigen::StrictlyUpper>() = information.matrix.transpose();
  const Eigen::MatrixXd HH = 0.5 * H.transpose() * H;
  EXPECT_LT((information.matrix - HH).norm(), 1e-9 * HH.norm());
  EXPECT_LT((information.vector - 0.5 * H.transpose() * r).norm(), 1e-9 * HH.norm());
  Eigen::VectorXd e(6 * 5);
  for (Eigen::Index k = 0; k < e.size(); ++k) e(k) = 0.01 * random.normal();
  EXPECT_NEAR(floor->squaredRest(e, first), (r - H * e).squaredNorm(),
              1e-9 * (r - H * e).squaredNorm());
  const Eigen::MatrixXd P = state.covariance().block(first, first, 30, 30);
  const Eigen::MatrixXd S = H * P * H.transpose() + Eigen::MatrixXd::Identity(rows, rows);
  const double distance = r.dot(S.ldlt().solve(r));
  EXPECT_NEAR(floor->distance(state), distance, 1e-6 * distance);
}

TEST(ChiSquare95, IsThatOfTheTables) {
  EXPECT_NEAR(chiSquare95(1), 3.841, 0.1);
  EXPECT_NEAR(chiSquare95(3), 7.815, 0.05);
  EXPECT_NEAR(chiSquare95(21), 32.67, 0.05);
}

TEST(CovarianceByFrames, IsTheScatterOfPointsSeenFromFramesThatErr) {
  RandomSource random(5);
  const WindowState state = sidewaysWindow(8);
  const Eigen::Vector3d point(4, 0.5, 1);
  constexpr std::size_t kAnchor = 5;
  const Eigen::MatrixXd P = state.covariance();
  const Eigen::MatrixXd root =
      Eigen::LLT<Eigen::MatrixXd>(P + 1e-16 * Eigen::MatrixXd::Identity(P.rows(), P.cols()))
          .matrixL();
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  constexpr int kDraws = 3000;
  for (int draw = 0; draw < kDraws; ++draw) {
    Eigen::VectorXd error(P.rows());
    for (Eigen::Index k = 0; k < error.size(); ++k) error(k) = 0.1 * random.normal();
    error = (root * error).eval();
    std::vector<TrackView> views;
    for (std::size_t i = 0; i < state.frames().size(); ++i) {
      Clone truly = state.frames()[i];
      const int at = state.frameCoordinate(i);
      truly.position_map += error.segment<3>(at);
      truly.R_map_rig = rotationOf(error.segment<3>(at + 3)) * truly.R_map_rig;
      views.push_back(viewOf(i, bearingTo(point, truly)));
    }
    const auto seen = triangulateTrack(state.frames(), kCamera_rig, views);
    ASSERT_TRUE(seen);
    const Clone& anchor = state.frames()[kAnchor];
    const int at = state.frameCoordinate(kAnchor);
    const Eigen::Vector3d from_anchor = seen->position_map - anchor.position_map;
    const double stretch = error(WindowState::kScale) +
                           anchor.stretch_by_bias_s_m.dot(error.segment<3>(WindowState::kBias));
    const Eigen::Vector3d moved = seen->position_map + error.segment<3>(at) +
                                  error.segment<3>(at + 3).cross(from_anchor) -
                                  stretch * from_anchor;
    scatter += (point - moved) * (point - moved).transpose() / (0.01 * kDraws);
  }
  const std::vector<TrackView> views = viewsOf(point, state, 0, random);
  const Eigen::Matrix3d covariance = covarianceByFrames(state, kCamera_rig, views, point, kAnchor);
  EXPECT_GT(covariance.trace(), 0.01) << "the depth is uncertain by decimetres";
  EXPECT_LT((covariance - scatter).norm(), 0.1 * covariance.norm()) << covariance << "\n\n"
                                                                    << scatter;
}

}  // namespace
}  // namespace ardrone_vslam
