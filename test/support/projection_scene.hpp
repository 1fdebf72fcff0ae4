// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#include "kernels/project/project_kernels.hpp"

// Landmarks about a camera, for tests of the projection kernels; needs no other library, so that it
// runs on bare cross-compiled programs too.
namespace ardrone_vslam::test {

/// Random numbers that are the same everywhere (splitmix64).
class SceneRandom {
 public:
  explicit SceneRandom(std::uint64_t seed) : state_(seed) {}
  float uniform(float low, float high) {
    return low + (high - low) * static_cast<float>(next() >> 40) * 0x1.0p-24F;
  }
  std::uint64_t next() {
    std::uint64_t x = state_ += 0x9e3779b97f4a7c15ULL;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
    return x ^ (x >> 31);
  }

 private:
  std::uint64_t state_;
};

struct ProjectionScene {
  /// Landmarks within 50 m of the camera on all sides, half of them with several exactly on a limit
  /// or not finite when `odd`.
  ProjectionScene(int count, std::uint64_t seed, bool odd) {
    SceneRandom random(seed);
    for (auto& column : columns) column.resize(static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      place(i, random);
      if (odd && random.next() % 2 == 0) makeOdd(i, random);
    }
    // A camera that looks along map's x, a little turned.
    const float turn[9] = {0.1F, -0.99F, 0.05F, 0, 0.05F, -1, 0.99F, 0.1F, 0};
    for (int k = 0; k < 9; ++k) camera.rows[k] = (k < 6 ? 500.F : 1.F) * turn[k];
    camera.position_m[0] = 0.5F;
    camera.position_m[1] = -0.25F;
    camera.position_m[2] = 1;
    camera.left_px = -320;
    camera.right_px = 319;
    camera.top_px = -180;
    camera.bottom_px = 179;
    camera.flattest2 = 0.0025F;
    camera.cosine2 = 0.25F;
    camera.nearest_m2 = 1e-6F;
    camera.ratio2 = 16;
  }

  kernels::ProjectColumns pointers() const {
    return {columns[0].data(), columns[1].data(), columns[2].data(), columns[3].data(),
            columns[4].data(), columns[5].data(), columns[6].data(), columns[7].data()};
  }

  std::vector<float> columns[8];
  kernels::ProjectCamera camera;

 private:
  void place(std::size_t i, SceneRandom& random) {
    for (std::size_t axis = 0; axis < 3; ++axis) columns[axis][i] = random.uniform(-50, 50);
    columns[3][i] = columns[2][i];
    float length2 = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      columns[4 + axis][i] = columns[axis][i] + random.uniform(-30, 30);
      length2 += columns[4 + axis][i] * columns[4 + axis][i];
    }
    for (std::size_t axis = 0; axis < 3; ++axis) columns[4 + axis][i] /= std::sqrt(length2);
    const float seen_m = random.uniform(1, 60);
    columns[7][i] = random.next() % 4 == 0 ? 0.F : seen_m * seen_m;
  }

  void makeOdd(std::size_t i, SceneRandom& random) {
    static const float kOdd[] = {0.F,   -0.F,  0.5F,     -0.25F,    1.F,
                                 1e20F, -1e6F, INFINITY, -INFINITY, NAN};
    for (auto& column : columns) {
      if (random.next() % 3 == 0) column[i] = kOdd[random.next() % 10];
    }
  }
};

struct ProjectedScene {
  explicit ProjectedScene(int count)
      : index(static_cast<std::size_t>(count + kernels::kProjectSlack)),
        x_px(index.size()),
        y_px(index.size()),
        distance_m(index.size()) {}

  kernels::ProjectOutput pointers() {
    return {index.data(), x_px.data(), y_px.data(), distance_m.data()};
  }

  std::vector<std::int32_t> index;
  std::vector<float> x_px;
  std::vector<float> y_px;
  std::vector<float> distance_m;
};

/// Whether the first `count` of two columns are equal bit for bit, NaNs and signs of 0 included.
template <class T>
bool sameBytes(const std::vector<T>& a, const std::vector<T>& b, int count) {
  return std::memcmp(a.data(), b.data(), static_cast<std::size_t>(count) * sizeof(T)) == 0;
}

}  // namespace ardrone_vslam::test
