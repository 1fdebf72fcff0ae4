// SPDX-License-Identifier: BSD-3-Clause
#include "kernels/project/project_kernels.hpp"

#include <gtest/gtest.h>

#include "kernels/kernels.hpp"
#include "support/grey_images.hpp"
#include "support/projection_scene.hpp"

namespace ardrone_vslam::test {
namespace {

using kernels::projectScalar;

class ProjectKernels : public ::testing::TestWithParam<InstructionSet> {};

/// @return how many are visible
int expectEqualScalar(InstructionSet set, const ProjectionScene& scene, int count) {
  ProjectedScene expected(count);
  ProjectedScene found(count);
  const int visible = projectScalar(scene.pointers(), count, scene.camera, expected.pointers());
  const auto project = kernels::kernelsFor(set).project;
  EXPECT_EQ(project(scene.pointers(), count, scene.camera, found.pointers()), visible);
  EXPECT_TRUE(sameBytes(found.index, expected.index, visible));
  EXPECT_TRUE(sameBytes(found.x_px, expected.x_px, visible));
  EXPECT_TRUE(sameBytes(found.y_px, expected.y_px, visible));
  EXPECT_TRUE(sameBytes(found.distance_m, expected.distance_m, visible));
  return visible;
}

TEST_P(ProjectKernels, EqualScalarBitForBit) {
  int visible = 0;
  for (const unsigned seed : testSeeds()) {
    SCOPED_TRACE(seed);
    for (int count = 0; count < 70; ++count) {
      for (const bool odd : {false, true})
        visible += expectEqualScalar(GetParam(), ProjectionScene(count, seed, odd), count);
    }
    visible += expectEqualScalar(GetParam(), ProjectionScene(20000, seed, false), 20000);
    visible += expectEqualScalar(GetParam(), ProjectionScene(20000, seed, true), 20000);
  }
  EXPECT_GT(visible, 1000);
}

TEST_P(ProjectKernels, EqualScalarWhenAllOrNoneAreVisibleAndInTwoDimensions) {
  ProjectionScene scene(1003, 5, false);
  scene.camera.left_px = scene.camera.top_px = -1e9F;
  scene.camera.right_px = scene.camera.bottom_px = 1e9F;
  scene.camera.cosine2 = -2;
  scene.camera.flattest2 = 0;
  scene.camera.ratio2 = 1e9F;
  const int half = expectEqualScalar(GetParam(), scene, 1003);
  EXPECT_GT(half, 400);
  for (float& x : scene.columns[0]) x = 1 + std::fabs(x);
  for (float& y : scene.columns[1]) y = 0;
  EXPECT_EQ(expectEqualScalar(GetParam(), scene, 1003), 1003);
  for (float& z : scene.columns[2]) z = 0;  // heights decide the pixel alone
  EXPECT_GT(expectEqualScalar(GetParam(), scene, 1003), 500);
  scene.camera.ratio2 = 0;
  for (float& seen_m2 : scene.columns[7]) seen_m2 = 1;
  EXPECT_EQ(expectEqualScalar(GetParam(), scene, 1003), 0);
}

INSTANTIATE_TEST_SUITE_P(Sets, ProjectKernels, ::testing::ValuesIn(supportedInstructionSets()),
                         [](const auto& parameter) { return nameOf(parameter.param); });

/// One landmark 10 m ahead of a camera at the origin that looks along x.
struct OneAhead {
  float x = 10, y = 0, z = 0, view[3] = {1, 0, 0}, seen_m2 = 100;
  kernels::ProjectCamera camera{
      {0, 0, 0}, {0, -500, 0, 0, 0, -500, 1, 0, 0}, -320, 319, -180, 179, 0.0025F, 0.25F, 1e-6F,
      16};
  ProjectedScene out{1};

  bool isVisible() {
    const kernels::ProjectColumns columns{&x, &y, &z, &z, &view[0], &view[1], &view[2], &seen_m2};
    return projectScalar(columns, 1, camera, out.pointers()) == 1;
  }
};

TEST(ProjectDefinition, PixelAndDistance) {
  OneAhead one;
  one.y = -2;
  one.z = 1;
  ASSERT_TRUE(one.isVisible());
  EXPECT_EQ(one.out.index[0], 0);
  EXPECT_FLOAT_EQ(one.out.x_px[0], 100);
  EXPECT_FLOAT_EQ(one.out.y_px[0], -50);
  EXPECT_FLOAT_EQ(one.out.distance_m[0], std::sqrt(105.F));
}

TEST(ProjectDefinition, CullsByImage) {
  for (const auto& [y, z, visible] :
       {std::tuple(6.39F, 0.F, true), std::tuple(6.41F, 0.F, false), std::tuple(-6.37F, 0.F, true),
        std::tuple(-6.39F, 0.F, false), std::tuple(0.F, 3.59F, true), std::tuple(0.F, 3.61F, false),
        std::tuple(0.F, -3.57F, true), std::tuple(0.F, -3.59F, false)}) {
    OneAhead one;
    one.y = y;
    one.z = z;
    EXPECT_EQ(one.isVisible(), visible) << y << ' ' << z;
  }
  OneAhead behind;
  behind.x = -10;
  behind.view[0] = -1;
  EXPECT_FALSE(behind.isVisible());
  OneAhead flat;  // 88 degrees off the axis, however wide the image
  flat.camera.left_px = -1e6F;
  flat.y = 10;
  flat.x = 0.4F;
  flat.camera.cosine2 = -2;
  EXPECT_FALSE(flat.isVisible());
  flat.x = 0.6F;
  EXPECT_TRUE(flat.isVisible());
}

TEST(ProjectDefinition, CullsByDistance) {
  for (const auto& [seen_m, visible] :
       {std::tuple(0.F, true), std::tuple(2.4F, false), std::tuple(2.6F, true),
        std::tuple(39.9F, true), std::tuple(40.1F, false)}) {
    OneAhead one;
    one.seen_m2 = seen_m * seen_m;
    EXPECT_EQ(one.isVisible(), visible) << seen_m;
  }
  OneAhead at_the_camera;
  at_the_camera.x = 0.0009F;
  at_the_camera.seen_m2 = 0;
  EXPECT_FALSE(at_the_camera.isVisible());
}

TEST(ProjectDefinition, CullsByDirection) {
  for (const auto& [limit_deg, off_deg, visible] :
       {std::tuple(60.0, 59.0, true), std::tuple(60.0, 61.0, false), std::tuple(120.0, 119.0, true),
        std::tuple(120.0, 121.0, false), std::tuple(120.0, 10.0, true),
        std::tuple(60.0, 170.0, false)}) {
    OneAhead one;
    const double cosine = std::cos(limit_deg * M_PI / 180);
    one.camera.cosine2 = static_cast<float>(cosine * std::abs(cosine));
    one.view[0] = static_cast<float>(std::cos(off_deg * M_PI / 180));
    one.view[1] = static_cast<float>(std::sin(off_deg * M_PI / 180));
    EXPECT_EQ(one.isVisible(), visible) << limit_deg << ' ' << off_deg;
  }
}

}  // namespace
}  // namespace ardrone_vslam::test
