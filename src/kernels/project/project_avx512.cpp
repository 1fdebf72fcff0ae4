// SPDX-License-Identifier: BSD-3-Clause
#include <immintrin.h>

#include "kernels/project/project_one.hpp"

namespace ardrone_vslam::kernels {
namespace {

/// Camera and limits in all lanes.
struct Camera16 {
  explicit Camera16(const ProjectCamera& c) {
    for (int i = 0; i < 3; ++i) position[i] = _mm512_set1_ps(c.position_m[i]);
    for (int i = 0; i < 9; ++i) rows[i] = _mm512_set1_ps(c.rows[i]);
    left = _mm512_set1_ps(c.left_px);
    right = _mm512_set1_ps(c.right_px);
    top = _mm512_set1_ps(c.top_px);
    bottom = _mm512_set1_ps(c.bottom_px);
    flattest2 = _mm512_set1_ps(c.flattest2);
    cosine2 = _mm512_set1_ps(c.cosine2);
    nearest2 = _mm512_set1_ps(c.nearest_m2);
    ratio2 = _mm512_set1_ps(c.ratio2);
  }

  __m512 position[3];
  __m512 rows[9];
  __m512 left, right, top, bottom;
  __m512 flattest2, cosine2, nearest2, ratio2;
};

inline __m512 dot(const __m512* row, __m512 x, __m512 y, __m512 z) {
  return _mm512_add_ps(_mm512_add_ps(_mm512_mul_ps(row[0], x), _mm512_mul_ps(row[1], y)),
                       _mm512_mul_ps(row[2], z));
}

/// Those of `lanes` where a > b.
inline __mmask16 above(__mmask16 lanes, __m512 a, __m512 b) {
  return _mm512_mask_cmp_ps_mask(lanes, a, b, _CMP_GT_OQ);
}

/// Those of `lanes` where a >= b.
inline __mmask16 atLeast(__mmask16 lanes, __m512 a, __m512 b) {
  return _mm512_mask_cmp_ps_mask(lanes, a, b, _CMP_GE_OQ);
}

/// Writes the lanes to be kept first; those behind them are overwritten by the next.
inline void put(float* to, __mmask16 keep, __m512 values) {
  _mm512_storeu_ps(to, _mm512_maskz_compress_ps(keep, values));
}

}  // namespace

int projectAvx512(const ProjectColumns& columns, int count, const ProjectCamera& camera,
                  const ProjectOutput& out) {
  const Camera16 c(camera);
  const __m512 zero = _mm512_setzero_ps();
  const __m512i lanes = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  int visible = 0;
  int i = 0;
  for (; i + 16 <= count; i += 16) {
    const __m512 dx = _mm512_sub_ps(_mm512_loadu_ps(columns.x_m + i), c.position[0]);
    const __m512 dy = _mm512_sub_ps(_mm512_loadu_ps(columns.y_m + i), c.position[1]);
    const __m512 image_dz = _mm512_sub_ps(_mm512_loadu_ps(columns.image_z_m + i), c.position[2]);
    const __m512 u = dot(c.rows, dx, dy, image_dz);
    const __m512 v = dot(c.rows + 3, dx, dy, image_dz);
    const __m512 w = dot(c.rows + 6, dx, dy, image_dz);
    const __m512 horizontal2 = _mm512_add_ps(_mm512_mul_ps(dx, dx), _mm512_mul_ps(dy, dy));
    const __m512 image2 = _mm512_add_ps(horizontal2, _mm512_mul_ps(image_dz, image_dz));
    __mmask16 keep = above(0xffff, w, zero);
    keep = above(keep, _mm512_mul_ps(w, w), _mm512_mul_ps(c.flattest2, image2));
    keep = atLeast(keep, u, _mm512_mul_ps(c.left, w));
    keep = atLeast(keep, _mm512_mul_ps(c.right, w), u);
    keep = atLeast(keep, v, _mm512_mul_ps(c.top, w));
    keep = atLeast(keep, _mm512_mul_ps(c.bottom, w), v);
    // As with AVX2. No further branch: it would be hard to predict, and costs more than it saves.
    if (keep == 0) continue;

    const __m512 dz = _mm512_sub_ps(_mm512_loadu_ps(columns.z_m + i), c.position[2]);
    const __m512 distance2 = _mm512_add_ps(horizontal2, _mm512_mul_ps(dz, dz));
    const __m512 seen2 = _mm512_loadu_ps(columns.seen_m2 + i);
    keep = atLeast(keep, distance2, c.nearest2);
    keep = atLeast(keep, _mm512_mul_ps(c.ratio2, distance2), seen2);
    keep = static_cast<__mmask16>(atLeast(keep, _mm512_mul_ps(c.ratio2, seen2), distance2) |
                                  _mm512_mask_cmp_ps_mask(keep, seen2, zero, _CMP_EQ_OQ));
    const __m512 view[3] = {_mm512_loadu_ps(columns.view_x + i),
                            _mm512_loadu_ps(columns.view_y + i),
                            _mm512_loadu_ps(columns.view_z + i)};
    const __m512 along = dot(view, dx, dy, dz);
    keep = atLeast(keep, _mm512_mul_ps(along, _mm512_abs_ps(along)),
                   _mm512_mul_ps(c.cosine2, distance2));
    const __m512i index = _mm512_add_epi32(_mm512_set1_epi32(i), lanes);
    _mm512_storeu_si512(out.index + visible, _mm512_maskz_compress_epi32(keep, index));
    put(out.x_px + visible, keep, _mm512_div_ps(u, w));
    put(out.y_px + visible, keep, _mm512_div_ps(v, w));
    put(out.distance_m + visible, keep, _mm512_maskz_sqrt_ps(keep, distance2));
    visible += __builtin_popcount(keep);
  }
  for (; i < count; ++i) visible = projectOne(columns, i, camera, out, visible);
  return visible;
}

}  // namespace ardrone_vslam::kernels
