// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "kernels/kernels.hpp"
#include "row.hpp"
#include "rows.hpp"

namespace ardrone_vslam::bench {
namespace {

constexpr int kLandmarks = 100'000;
constexpr int kColumns = 8;
constexpr int kPoses = 16;

/// Landmarks about a street of 400 m, last seen from 5 to 40 m in any direction.
struct Street {
  std::vector<float> values[kColumns];
  kernels::ProjectColumns columns{};

  Street() {
    std::mt19937 random(1);
    const auto uniform = [&](float low, float high) {
      return std::uniform_real_distribution<float>(low, high)(random);
    };
    for (int i = 0; i < kLandmarks; ++i) {
      const float turn = uniform(-3.14159F, 3.14159F);
      const float seen_m = uniform(5, 40);
      const float z = uniform(-2, 8);
      const float row[kColumns] = {uniform(0, 400), uniform(-30, 30), z, z,
                                   std::cos(turn),  std::sin(turn),   0, seen_m * seen_m};
      for (int c = 0; c < kColumns; ++c) values[c].push_back(row[c]);
    }
    columns = {values[0].data(), values[1].data(), values[2].data(), values[3].data(),
               values[4].data(), values[5].data(), values[6].data(), values[7].data()};
  }
};

/// KITTI's camera on the way along the street, turning a little.
kernels::ProjectCamera cameraAt(std::size_t i) {
  constexpr float kFocal_px = 720;
  const float yaw = 0.3F * std::sin(static_cast<float>(i));
  const float c = std::cos(yaw);
  const float s = std::sin(yaw);
  kernels::ProjectCamera camera{};
  camera.position_m[0] = 25.F * static_cast<float>(i % kPoses);
  const float rows[9] = {kFocal_px * s, -kFocal_px * c, 0, 0, 0, -kFocal_px, c, s, 0};
  for (int k = 0; k < 9; ++k) camera.rows[k] = rows[k];
  camera.left_px = -621;
  camera.right_px = 621;
  camera.top_px = -188;
  camera.bottom_px = 188;
  camera.flattest2 = 0.04F;
  camera.cosine2 = 0.25F;
  camera.nearest_m2 = 0.25F;
  camera.ratio2 = 4;
  return camera;
}

auto projection(InstructionSet set) {
  return [set] {
    struct State {
      Street street;
      std::vector<std::int32_t> index = std::vector<std::int32_t>(kLandmarks + 16);
      std::vector<float> x_px = std::vector<float>(kLandmarks + 16);
      std::vector<float> y_px = x_px;
      std::vector<float> distance_m = x_px;
    };
    auto s = std::make_shared<State>();
    const auto project = kernels::kernelsFor(set).project;
    return [=](std::size_t i) {
      const kernels::ProjectOutput out{s->index.data(), s->x_px.data(), s->y_px.data(),
                                       s->distance_m.data()};
      return static_cast<std::size_t>(project(s->street.columns, kLandmarks, cameraAt(i), out));
    };
  };
}

}  // namespace

void addProjectionRows() {
  side("project_100k", "ours", projection(instructionSetInUse().set));
  side("project_100k", "our scalar form", projection(InstructionSet::kScalar));
}

}  // namespace ardrone_vslam::bench
