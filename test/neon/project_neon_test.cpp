// SPDX-License-Identifier: BSD-3-Clause
// Cross-compiled for ARM and run under emulation: no test library there.
#include <cstdio>

#include "support/projection_scene.hpp"

namespace ardrone_vslam::test {
namespace {

/// @return how many are visible; -1 if the forms differ
int compare(int count, std::uint64_t seed, bool odd) {
  const ProjectionScene scene(count, seed, odd);
  ProjectedScene expected(count);
  ProjectedScene found(count);
  const int visible =
      kernels::projectScalar(scene.pointers(), count, scene.camera, expected.pointers());
  const bool same =
      kernels::projectNeon(scene.pointers(), count, scene.camera, found.pointers()) == visible &&
      sameBytes(found.index, expected.index, visible) &&
      sameBytes(found.x_px, expected.x_px, visible) &&
      sameBytes(found.y_px, expected.y_px, visible) &&
      sameBytes(found.distance_m, expected.distance_m, visible);
  return same ? visible : -1;
}

}  // namespace

/// @return number of faults
int testProjectNeon() {
  int faults = 0;
  int visible_in_all = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    for (int count = 0; count < 5000; count = count < 40 ? count + 1 : count * 3 + 1) {
      for (const bool odd : {false, true}) {
        const int visible = compare(count, seed, odd);
        if (visible < 0) {
          std::printf("projectNeon differs from projectScalar: count %d, seed %d, odd %d\n", count,
                      static_cast<int>(seed), odd ? 1 : 0);
          ++faults;
        }
        visible_in_all += visible;
      }
    }
  }
  if (visible_in_all < 100) {
    std::printf("projectNeon: hardly a landmark was visible, the test says nothing\n");
    ++faults;
  }
  return faults;
}

}  // namespace ardrone_vslam::test
