// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/camera_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace ardrone_vslam {
namespace {

CameraIntrinsics ardroneFront() {
  CameraIntrinsics c;
  c.width_px = 640;
  c.height_px = 360;
  c.fx_px = 570;
  c.fy_px = 568;
  c.cx_px = 320;
  c.cy_px = 180;
  c.k1 = -0.525;
  c.k2 = 0.274;
  return c;
}

double largestRoundTripError_px(const CameraModel& camera) {
  double worst = 0;
  for (int y = 0; y < camera.intrinsics().height_px; y += 7) {
    for (int x = 0; x < camera.intrinsics().width_px; x += 7) {
      const Eigen::Vector2d pixel(x, y);
      const auto ray = camera.bearing(pixel);
      if (!ray) return std::numeric_limits<double>::infinity();
      EXPECT_NEAR(ray->norm(), 1, 1e-12);
      worst = std::max(worst, (*camera.project(*ray * 3.7) - pixel).norm());
    }
  }
  return worst;
}

class ExactUndistortion : public testing::TestWithParam<UndistortMethod> {};

TEST_P(ExactUndistortion, projectUndoesBearingOnTheWholeImage) {
  EXPECT_LT(largestRoundTripError_px(CameraModel(ardroneFront(), GetParam())), 1e-6);
}

TEST_P(ExactUndistortion, projectUndoesBearingWithTangentialTerms) {
  CameraIntrinsics c = ardroneFront();
  c.p1 = 0.002;
  c.p2 = -0.001;
  c.k3 = -0.02;
  EXPECT_LT(largestRoundTripError_px(CameraModel(c, GetParam())), 1e-6);
}

TEST_P(ExactUndistortion, projectUndoesBearingWhereNewtonsStepsWouldGoToAndFro) {
  CameraIntrinsics c = ardroneFront();
  c.fx_px = c.fy_px = 240;  // radius 1.38 at a distorted 1.38; slope 0.6 there, 1 in the middle
  c.k1 = 0.233571;
  c.k2 = 0.391884;
  c.k3 = -0.18387;
  const CameraModel camera(c, GetParam());
  for (double x = 320; x < 800; x += 0.1) {
    const auto ray = camera.bearing({x, 180});
    ASSERT_TRUE(ray) << x;
    ASSERT_NEAR(camera.project(*ray)->x(), x, 1e-6);
  }
}

TEST_P(ExactUndistortion, theWidestPinholeIsOneUpToItsCorners) {
  CameraIntrinsics c = ardroneFront();
  c.fx_px = c.fy_px = kShortestFocal * c.width_px;
  c.k1 = c.k2 = 0;
  EXPECT_LT(largestRoundTripError_px(CameraModel(c, GetParam())), 1e-6);
}

TEST_P(ExactUndistortion, refusesWhatIsMoreThan84DegreesOffTheAxisOfADistortingLens) {
  CameraIntrinsics c = ardroneFront();
  c.fx_px = c.fy_px = kShortestFocal * c.width_px;
  c.k1 = 1e-6;
  c.k2 = 0;
  const CameraModel camera(c, GetParam());
  EXPECT_TRUE(camera.bearing({320 + 319, 180}));
  EXPECT_FALSE(camera.bearing({320 + 321, 180}));
  EXPECT_TRUE(camera.project({9.99, 0, 1}));
  EXPECT_FALSE(camera.project({10.01, 0, 1}));
}

INSTANTIATE_TEST_SUITE_P(All, ExactUndistortion,
                         testing::Values(UndistortMethod::kTable, UndistortMethod::kExact));

TEST(CameraModel, theTableIsTheExactInverseOfTheShippedCameras) {
  CameraIntrinsics wide = ardroneFront();
  wide.fx_px = wide.fy_px = 470.5;
  wide.k1 = -0.53;
  wide.k2 = 0.28;
  CameraIntrinsics bottom;
  bottom.width_px = 320;
  bottom.height_px = 240;
  bottom.fx_px = bottom.fy_px = 316.8;
  bottom.cx_px = 160;
  bottom.cy_px = 120;
  bottom.k1 = 0.12;
  bottom.k2 = -0.24;
  for (const CameraIntrinsics& c : {ardroneFront(), wide, bottom}) {
    const CameraModel table(c, UndistortMethod::kTable);
    const CameraModel exact(c, UndistortMethod::kExact);
    for (int y = 0; y < c.height_px; ++y) {
      for (int x = 0; x < c.width_px; ++x) {
        const auto a = table.bearing({x, y});
        const auto b = exact.bearing({x, y});
        ASSERT_TRUE(a && b);
        ASSERT_LT(c.fx_px * (a->head<2>() / a->z() - b->head<2>() / b->z()).norm(), 1e-6);
      }
    }
  }
}

TEST(CameraModel, closedFormIsAsFarOffAsDesignedForTheDronesLens) {
  // Three terms of Drap & Lefevre leave a mean error of 0.43 px for f 570, k1 -0.53, k2 0.28 on
  // 640x360.
  CameraIntrinsics c = ardroneFront();
  c.fx_px = c.fy_px = 570;
  c.k1 = -0.53;
  c.k2 = 0.28;
  const CameraModel exact(c);
  const CameraModel closed(c, UndistortMethod::kClosedForm);
  double sum = 0;
  int count = 0;
  for (int y = 0; y < c.height_px; ++y) {
    for (int x = 0; x < c.width_px; ++x) {
      const auto a = exact.bearing({x, y});
      const auto b = closed.bearing({x, y});
      ASSERT_TRUE(a && b);
      sum += 570 * (a->head<2>() / a->z() - b->head<2>() / b->z()).norm();
      ++count;
    }
  }
  EXPECT_NEAR(sum / count, 0.43, 0.3);
  EXPECT_GT(sum / count, 0.05);
}

TEST(CameraModel, bearingPointsRightDownForward) {
  const CameraModel camera(ardroneFront());
  const auto ray = camera.bearing({420, 280});
  ASSERT_TRUE(ray);
  EXPECT_GT(ray->x(), 0);
  EXPECT_GT(ray->y(), 0);
  EXPECT_GT(ray->z(), 0);
}

TEST(CameraModel, pixelsBeyondTheFoldAreRefused) {
  CameraIntrinsics c = ardroneFront();
  c.fx_px = c.fy_px = 570;
  c.k1 = -0.53;
  c.k2 = 0;
  const CameraModel camera(c);
  // 1 + 3 k1 r^2 = 0: undistorted 452 px, distorted 301 px from the centre.
  EXPECT_NEAR(camera.foldRadius() * 570, 452, 1);
  EXPECT_TRUE(camera.bearing({320 + 300, 180}));
  EXPECT_FALSE(camera.bearing({320 + 303, 180}));
  EXPECT_FALSE(camera.project({2, 0, 1}));
}

TEST(CameraModel, nothingBehindTheCamera) {
  const CameraModel camera(ardroneFront());
  EXPECT_FALSE(camera.project({0, 0, -1}));
  EXPECT_FALSE(camera.project({0, 0, 0}));
}

TEST(CameraModel, refusesWhatCannotBeACamera) {
  CameraIntrinsics c = ardroneFront();
  c.fx_px = 0;
  EXPECT_THROW(CameraModel{c}, std::invalid_argument);
  c = ardroneFront();
  c.k1 = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(CameraModel{c}, std::invalid_argument);
  c = ardroneFront();
  c.width_px = 0;
  EXPECT_THROW(CameraModel{c}, std::invalid_argument);
}

struct Absurd {
  double CameraIntrinsics::*value;
  double number;
  const char* named;
};

class AbsurdCalibration : public testing::TestWithParam<Absurd> {};

TEST_P(AbsurdCalibration, IsRefusedByName) {
  CameraIntrinsics c = ardroneFront();
  EXPECT_EQ(calibrationFault(c), "");
  c.*GetParam().value = GetParam().number;
  EXPECT_NE(calibrationFault(c).find(GetParam().named), std::string::npos) << calibrationFault(c);
  EXPECT_THROW(CameraModel{c}, std::invalid_argument);
}

INSTANTIATE_TEST_SUITE_P(
    All, AbsurdCalibration,
    testing::Values(Absurd{&CameraIntrinsics::fx_px, 1e300, "focal length 1e+300 px"},
                    Absurd{&CameraIntrinsics::fy_px, 1e-300, "focal length 1e-300 px"},
                    Absurd{&CameraIntrinsics::fx_px, 31.9, "0.05 and 50 times"},
                    Absurd{&CameraIntrinsics::fx_px, 32001, "0.05 and 50 times"},
                    Absurd{&CameraIntrinsics::cx_px, 1e300, "principal point (1e+300, 180)"},
                    Absurd{&CameraIntrinsics::cy_px, -1, "principal point (320, -1)"},
                    Absurd{&CameraIntrinsics::k1, 1e300, "k1 1e+300"},
                    Absurd{&CameraIntrinsics::k1, -900, "folds back"},
                    Absurd{&CameraIntrinsics::k1, 900, "more than a fifth"},
                    Absurd{&CameraIntrinsics::k2, -1e300, "folds back"},
                    Absurd{&CameraIntrinsics::k3, 1e300, "k3 1e+300"},
                    Absurd{&CameraIntrinsics::p1, 3, "p1 3"},
                    Absurd{&CameraIntrinsics::p2, -1e300, "p2 -1e+300"}));

TEST(CameraModel, AFoldBeforeTheImagesEdgeIsNoFault) {
  CameraIntrinsics c = ardroneFront();
  c.k1 = -3;  // folds at a third of the half diagonal
  c.k2 = 0;
  EXPECT_EQ(calibrationFault(c), "");
  EXPECT_TRUE(CameraModel(c).bearing({400, 180}));
  EXPECT_FALSE(CameraModel(c).bearing({600, 180}));
}

}  // namespace
}  // namespace ardrone_vslam
