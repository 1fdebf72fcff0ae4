// SPDX-License-Identifier: BSD-3-Clause
#include "matching/frame_view.hpp"

#include <gtest/gtest.h>

#include "support/view_builder.hpp"

namespace ardrone_vslam {
namespace {

using test::ViewBuilder;

/// Features whose ideal pixel is within the radius.
std::vector<int> featuresAt(const FrameView& view, const Eigen::Vector2f& centre_px,
                            float radius_px) {
  std::vector<int> found;
  for (std::size_t i = 0; i < view.size(); ++i) {
    if ((view.idealPixels()[i] - centre_px).norm() <= radius_px)
      found.push_back(static_cast<int>(i));
  }
  return found;
}

TEST(FrameView, IdealPixelsAreRelativeToTheOpticalAxis) {
  ViewBuilder builder;
  builder.lookFrom({0, 0, 0});
  builder.addPixel(100, -50, 1);
  builder.addPixel(-320, 179, 2);
  ASSERT_EQ(builder.view().idealPixels().size(), 2U);
  EXPECT_LT((builder.view().idealPixels()[0] - Eigen::Vector2f(100, -50)).norm(), 1e-3);
  EXPECT_LT((builder.view().idealPixels()[1] - Eigen::Vector2f(-320, 179)).norm(), 1e-3);
}

TEST(FrameView, IdealPixelIsWhereTheFeatureOfAPointIs) {
  ViewBuilder builder;
  builder.lookFrom({1, 2, 3});
  builder.addFrame();
  const Eigen::Vector3d point(6, 2.5, 3.4);
  const int feature = builder.addPoint(point, 1);
  Eigen::Vector2f pixel;
  ASSERT_TRUE(builder.view().idealPixel(point - builder.view().origin_map(), 0, pixel));
  EXPECT_EQ(featuresAt(builder.view(), pixel, 0.01F), std::vector<int>{feature});
  EXPECT_FALSE(builder.view().idealPixel({-5, 0, 0}, 0, pixel)) << "behind";
  EXPECT_FALSE(builder.view().idealPixel({5, 5, 0}, 0, pixel)) << "outside the image";
}

TEST(FrameView, ExtentIsThatOfAllFramesSoFar) {
  ViewBuilder builder;
  builder.lookFrom({0, 0, 0});
  builder.addFrame();
  Eigen::Vector2f pixel;
  EXPECT_TRUE(builder.view().idealPixel({5, 2, 0}, 0, pixel));
  builder.lookFrom({0, 0, 0});
  builder.addPixel(0, 0, 1);
  EXPECT_TRUE(builder.view().idealPixel({5, 2, 0}, 0, pixel)) << "the camera has shown it before";
}

TEST(FrameView, BearingsFarOffTheAxisDoNoHarm) {
  ViewBuilder builder;
  builder.lookFrom({0, 0, 0});
  const int good = builder.addPixel(10, 0, 1);
  const std::vector<Eigen::Vector3f> wide{{1, 0, 0}, {0, -1, 0}, {0, 0, -1}, {1, 0, 1e-30F}};
  for (const Eigen::Vector3f& bearing : wide) {
    builder.addPixel(0, 0, 2);
    builder.features().bearing_cam.back() = bearing;
  }
  EXPECT_EQ(featuresAt(builder.view(), {10, 0}, 5), std::vector<int>{good});
  for (std::size_t i = 0; i < builder.view().size(); ++i)
    EXPECT_TRUE(builder.view().ray(i).direction_map.allFinite());
}

TEST(FrameView, PlanarRaysAreHorizontalUnitVectors) {
  ViewBuilder builder;
  builder.lookFrom({1, 2, 0}, true);
  const Eigen::Vector3d point(5, 3, 1.2);  // within the frame, not at its border
  builder.addPoint(point, 1);
  const FrameView& view = builder.view();
  const Eigen::Vector3d ray = view.ray(0).direction_map;
  EXPECT_EQ(ray.z(), 0);
  EXPECT_NEAR(ray.norm(), 1, 1e-12);
  const Eigen::Vector2d offset = point.head<2>() - Eigen::Vector2d(1, 2);
  EXPECT_LT((ray.head<2>() - offset.normalized()).norm(), 1e-6);
  EXPECT_NEAR(view.elevation(0), point.z() / offset.norm(), 1e-6);
  Eigen::Vector2f pixel;
  builder.addFrame();
  ASSERT_TRUE(builder.view().idealPixel(ray, builder.view().elevation(0), pixel));
  EXPECT_EQ(featuresAt(builder.view(), pixel, 0.01F), std::vector<int>{0});
}

TEST(FrameView, SigmaSinceIsTheDriftAlone) {
  FrameView view;
  view.setPositionVariance(0.25, true);
  EXPECT_NEAR(view.sigmaSince_m(0.09), 0.4, 1e-12);
  EXPECT_EQ(view.sigmaSince_m(0.3), 0) << "never the root of something negative";
  view.setPositionVariance(0.25, false);
  EXPECT_NEAR(view.sigmaSince_m(0.09), 0.5, 1e-12);
}

TEST(FrameView, NewOriginMovesTheRays) {
  ViewBuilder builder;
  builder.lookFrom({0, 0, 0});
  builder.addPixel(0, 0, 1);
  builder.view().setOrigin({1, 2, 3});
  EXPECT_EQ(builder.view().ray(0).origin_map, Eigen::Vector3d(1, 2, 3));
}

TEST(FrameView, WhereTheDriftSinceAnAnchorIsKnownItCounts) {
  FrameView view;
  view.setPositionVariance(0.25, true);
  view.setDrifts({{3, 0.04, 0.0}, {8, 0.0, 1e-4}, {9, 0.04, 1e-4}});
  EXPECT_NEAR(view.driftAngle_rad(3, 0.25, 4), 0.2 / 4, 1e-12);
  EXPECT_NEAR(view.driftAngle_rad(8, 0.25, 4), 0.01, 1e-12);
  EXPECT_NEAR(view.driftAngle_rad(9, 0.25, 4), std::hypot(0.05, 0.01), 1e-12);
  EXPECT_NEAR(view.driftAngle_rad(5, 0.09, 4), 0.4 / 4, 1e-12) << "an anchor that is not known";
}

}  // namespace
}  // namespace ardrone_vslam
