// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kernels/project/project_kernels.hpp"

// The definition for one landmark. Static: each file that includes it has its own, compiled for
// its instruction set.
namespace ardrone_vslam::kernels {

/// Adds landmark i at place `visible` if it is visible. @return the number of visible ones then
static inline int projectOne(const ProjectColumns& columns, int i, const ProjectCamera& camera,
                             const ProjectOutput& out, int visible) {
  const float* r = camera.rows;
  const float dx = columns.x_m[i] - camera.position_m[0];
  const float dy = columns.y_m[i] - camera.position_m[1];
  const float dz = columns.z_m[i] - camera.position_m[2];
  const float image_dz = columns.image_z_m[i] - camera.position_m[2];
  const float w = (r[6] * dx + r[7] * dy) + r[8] * image_dz;
  const float horizontal2 = dx * dx + dy * dy;
  if (!(w > 0.F && w * w > camera.flattest2 * (horizontal2 + image_dz * image_dz))) return visible;
  const float u = (r[0] * dx + r[1] * dy) + r[2] * image_dz;
  if (!(u >= camera.left_px * w && u <= camera.right_px * w)) return visible;
  const float v = (r[3] * dx + r[4] * dy) + r[5] * image_dz;
  if (!(v >= camera.top_px * w && v <= camera.bottom_px * w)) return visible;

  const float distance2 = horizontal2 + dz * dz;
  const float seen2 = columns.seen_m2[i];
  const bool in_range = distance2 >= camera.nearest_m2 && seen2 <= camera.ratio2 * distance2 &&
                        (distance2 <= camera.ratio2 * seen2 || seen2 == 0.F);
  const float along = (columns.view_x[i] * dx + columns.view_y[i] * dy) + columns.view_z[i] * dz;
  if (!(in_range && along * __builtin_fabsf(along) >= camera.cosine2 * distance2)) return visible;
  out.index[visible] = i;
  out.x_px[visible] = u / w;
  out.y_px[visible] = v / w;
  out.distance_m[visible] = __builtin_sqrtf(distance2);
  return visible + 1;
}

}  // namespace ardrone_vslam::kernels
