// SPDX-License-Identifier: BSD-3-Clause
#include <arm_neon.h>

#include "kernels/project/project_one.hpp"

namespace ardrone_vslam::kernels {
namespace {

/// Products and sums apart, never fused, as the definition has them.
inline float32x4_t dot(const float* row, float32x4_t x, float32x4_t y, float32x4_t z) {
  return vaddq_f32(vaddq_f32(vmulq_n_f32(x, row[0]), vmulq_n_f32(y, row[1])),
                   vmulq_n_f32(z, row[2]));
}

inline bool isAny(uint32x4_t mask) {
  const uint32x2_t half = vorr_u32(vget_low_u32(mask), vget_high_u32(mask));
  return vget_lane_u64(vreinterpret_u64_u32(half), 0) != 0;
}

}  // namespace

// The vectors decide which landmarks are in the image. What they let through is tested in full by
// the definition: ARMv7 has no vector division or root, and few landmarks come so far.
int projectNeon(const ProjectColumns& columns, int count, const ProjectCamera& camera,
                const ProjectOutput& out) {
  const float* position = camera.position_m;
  int visible = 0;
  int i = 0;
  for (; i + 4 <= count; i += 4) {
    const float32x4_t dx = vsubq_f32(vld1q_f32(columns.x_m + i), vdupq_n_f32(position[0]));
    const float32x4_t dy = vsubq_f32(vld1q_f32(columns.y_m + i), vdupq_n_f32(position[1]));
    const float32x4_t dz = vsubq_f32(vld1q_f32(columns.image_z_m + i), vdupq_n_f32(position[2]));
    const float32x4_t u = dot(camera.rows, dx, dy, dz);
    const float32x4_t v = dot(camera.rows + 3, dx, dy, dz);
    const float32x4_t w = dot(camera.rows + 6, dx, dy, dz);
    uint32x4_t keep = vcgtq_f32(w, vdupq_n_f32(0.F));
    keep = vandq_u32(keep, vcgeq_f32(u, vmulq_n_f32(w, camera.left_px)));
    keep = vandq_u32(keep, vcleq_f32(u, vmulq_n_f32(w, camera.right_px)));
    keep = vandq_u32(keep, vcgeq_f32(v, vmulq_n_f32(w, camera.top_px)));
    keep = vandq_u32(keep, vcleq_f32(v, vmulq_n_f32(w, camera.bottom_px)));
    if (!isAny(keep)) continue;
    std::uint32_t lanes[4];
    vst1q_u32(lanes, keep);
    for (int lane = 0; lane < 4; ++lane) {
      if (lanes[lane] != 0) visible = projectOne(columns, i + lane, camera, out, visible);
    }
  }
  for (; i < count; ++i) visible = projectOne(columns, i, camera, out, visible);
  return visible;
}

}  // namespace ardrone_vslam::kernels
