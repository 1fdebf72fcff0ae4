// SPDX-License-Identifier: BSD-3-Clause
// The lens table beside Newton's method on random cameras.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <limits>
#include <random>

#include "ardrone_vslam/camera_model.hpp"
#include "simulation/random_source.hpp"
#include "support/seeds.hpp"

namespace ardrone_vslam {
namespace {

constexpr int kCameras = 60;
constexpr int kPixels = 2000;

/// Any lens that passes for one: barrels, pincushions, folds within and beyond the image, half of
/// them with a third term; fields of view of 35 to 128 degrees.
CameraIntrinsics randomCamera(RandomSource& random) {
  for (;;) {
    CameraIntrinsics c;
    c.width_px = static_cast<int>(random.uniform(160, 1920));
    c.height_px = static_cast<int>(random.uniform(120, 1080));
    c.fx_px = c.width_px * random.uniform(0.25, 1.6);
    c.fy_px = c.fx_px * random.uniform(0.97, 1.03);
    c.cx_px = c.width_px * random.uniform(0.4, 0.6);
    c.cy_px = c.height_px * random.uniform(0.4, 0.6);
    c.k1 = random.uniform(-0.7, 0.3);
    c.k2 = random.uniform(-0.3, 0.5);
    if (random.uniform(0, 1) < 0.5) c.k3 = random.uniform(-0.2, 0.2);
    if (calibrationFault(c).empty()) return c;
  }
}

/// Also somewhat outside of the image.
Eigen::Vector2d randomPixel(const CameraIntrinsics& c, RandomSource& random) {
  return {random.uniform(-0.1, 1.1) * c.width_px, random.uniform(-0.1, 1.1) * c.height_px};
}

Eigen::Vector2d onPlane_px(const CameraIntrinsics& c, const Eigen::Vector3d& bearing) {
  return Eigen::Vector2d(c.fx_px * bearing.x(), c.fy_px * bearing.y()) / bearing.z();
}

struct Comparison {
  double worst_px = 0;
  double worst_norm_error = 0;
  int refused = 0;
  int refused_by_one = 0;
};

void compare(const CameraIntrinsics& c, RandomSource& random, Comparison& result) {
  const CameraModel table(c, UndistortMethod::kTable);
  const CameraModel exact(c, UndistortMethod::kExact);
  for (int i = 0; i < kPixels; ++i) {
    const Eigen::Vector2d pixel = randomPixel(c, random);
    const auto a = table.bearing(pixel);
    const auto b = exact.bearing(pixel);
    result.refused += !b;
    result.refused_by_one += a.has_value() != b.has_value();
    if (!a || !b) continue;
    result.worst_px = std::max(result.worst_px, (onPlane_px(c, *a) - onPlane_px(c, *b)).norm());
    result.worst_norm_error = std::max(result.worst_norm_error, std::abs(a->norm() - 1));
  }
}

TEST(LensTableProperty, AgreesWithNewtonAndRefusesTheSamePixels) {
  for (const std::uint64_t seed : test::seeds()) {
    RandomSource random(seed);
    Comparison all;
    for (int i = 0; i < kCameras; ++i) compare(randomCamera(random), random, all);
    EXPECT_LT(all.worst_px, 1e-6) << seed;
    EXPECT_LT(all.worst_norm_error, 1e-12) << seed;
    EXPECT_EQ(all.refused_by_one, 0) << seed;
    EXPECT_GT(all.refused, 0) << seed;
  }
}

TEST(LensTableProperty, AgreesWithNewtonWithTangentialTerms) {
  // No fresh seed: at the fold, which these terms move, either may fail to converge.
  for (const std::uint64_t seed : {1, 2, 3}) {
    RandomSource random(seed);
    Comparison all;
    for (int i = 0; i < kCameras; ++i) {
      CameraIntrinsics c = randomCamera(random);
      c.p1 = random.uniform(-0.003, 0.003);
      c.p2 = random.uniform(-0.003, 0.003);
      if (calibrationFault(c).empty()) compare(c, random, all);
    }
    EXPECT_LT(all.worst_px, 1e-6) << seed;
    EXPECT_EQ(all.refused_by_one, 0) << seed;
  }
}

TEST(LensTableProperty, TheFoldIsTheSameToItsLastBit) {
  for (const std::uint64_t seed : test::seeds()) {
    RandomSource random(seed);
    int folds = 0;
    for (int i = 0; i < kCameras; ++i) {
      const CameraIntrinsics c = randomCamera(random);
      const CameraModel table(c, UndistortMethod::kTable);
      const CameraModel exact(c, UndistortMethod::kExact);
      double inside = c.cx_px;
      double outside = 20 * c.fx_px;
      if (exact.bearing({outside, c.cy_px})) continue;
      while (std::nextafter(inside, outside) < outside) {
        const double middle = 0.5 * (inside + outside);
        (exact.bearing({middle, c.cy_px}) ? inside : outside) = middle;
      }
      ++folds;
      EXPECT_TRUE(table.bearing({inside, c.cy_px})) << seed << ' ' << i;
      EXPECT_FALSE(table.bearing({outside, c.cy_px})) << seed << ' ' << i;
    }
    EXPECT_GT(folds, kCameras / 4);
  }
}

TEST(LensTableProperty, RisesWithTheRadius) {
  for (const std::uint64_t seed : test::seeds()) {
    RandomSource random(seed);
    for (int i = 0; i < kCameras; ++i) {
      const CameraIntrinsics c = randomCamera(random);
      const CameraModel camera(c, UndistortMethod::kTable);
      double before = -1;
      for (double x = c.cx_px; x < 1.2 * c.width_px; x += 0.01) {
        const auto ray = camera.bearing({x, c.cy_px});
        if (!ray) break;
        ASSERT_GT(ray->x() / ray->z(), before) << seed << ' ' << i << " at " << x;
        before = ray->x() / ray->z();
      }
    }
  }
}

TEST(LensTableProperty, ProjectionUndoesIt) {
  for (const std::uint64_t seed : test::seeds()) {
    RandomSource random(seed);
    for (int i = 0; i < kCameras; ++i) {
      const CameraIntrinsics c = randomCamera(random);
      const CameraModel camera(c, UndistortMethod::kTable);
      for (int k = 0; k < kPixels; ++k) {
        const Eigen::Vector2d pixel = randomPixel(c, random);
        const auto ray = camera.bearing(pixel);
        if (!ray) continue;
        const auto back = camera.project(*ray * random.uniform(0.1, 100));
        ASSERT_TRUE(back) << seed << ' ' << i;
        ASSERT_LT((*back - pixel).norm(), 1e-6) << seed << ' ' << i;
      }
    }
  }
}

TEST(LensTableProperty, NoDistortionIsThePinholeToTheLastBit) {
  for (const std::uint64_t seed : test::seeds()) {
    RandomSource random(seed);
    for (int i = 0; i < kCameras; ++i) {
      CameraIntrinsics c = randomCamera(random);
      c.fx_px = c.width_px * random.uniform(kShortestFocal, 2);  // up to 169 degrees
      c.k1 = c.k2 = c.k3 = 0;
      for (const auto method :
           {UndistortMethod::kTable, UndistortMethod::kExact, UndistortMethod::kClosedForm}) {
        const CameraModel camera(c, method);
        const Eigen::Vector2d pixel = randomPixel(c, random);
        const Eigen::Vector3d pinhole((pixel.x() - c.cx_px) / c.fx_px,
                                      (pixel.y() - c.cy_px) / c.fy_px, 1);
        ASSERT_EQ(camera.bearing(pixel), pinhole.normalized()) << seed << ' ' << i;
      }
    }
  }
}

}  // namespace
}  // namespace ardrone_vslam
