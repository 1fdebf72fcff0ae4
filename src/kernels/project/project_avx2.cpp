// SPDX-License-Identifier: BSD-3-Clause
#include <immintrin.h>

#include "kernels/project/project_one.hpp"

namespace ardrone_vslam::kernels {
namespace {

/// For each mask of 8 lanes: the numbers of those set, one a byte, the lowest first.
struct CompactTable {
  std::uint64_t lanes[256];

  constexpr CompactTable() : lanes() {
    for (unsigned mask = 0; mask < 256; ++mask) {
      unsigned place = 0;
      for (std::uint64_t lane = 0; lane < 8; ++lane) {
        if (((mask >> lane) & 1U) == 0) continue;
        lanes[mask] |= lane << (8 * place);
        ++place;
      }
    }
  }
};
constexpr CompactTable kCompact;

/// Camera and limits in all lanes.
struct Camera8 {
  explicit Camera8(const ProjectCamera& c) {
    for (int i = 0; i < 3; ++i) position[i] = _mm256_set1_ps(c.position_m[i]);
    for (int i = 0; i < 9; ++i) rows[i] = _mm256_set1_ps(c.rows[i]);
    left = _mm256_set1_ps(c.left_px);
    right = _mm256_set1_ps(c.right_px);
    top = _mm256_set1_ps(c.top_px);
    bottom = _mm256_set1_ps(c.bottom_px);
    flattest2 = _mm256_set1_ps(c.flattest2);
    cosine2 = _mm256_set1_ps(c.cosine2);
    nearest2 = _mm256_set1_ps(c.nearest_m2);
    ratio2 = _mm256_set1_ps(c.ratio2);
  }

  __m256 position[3];
  __m256 rows[9];
  __m256 left, right, top, bottom;
  __m256 flattest2, cosine2, nearest2, ratio2;
};

inline __m256 dot(__m256 a, __m256 b, __m256 c, __m256 x, __m256 y, __m256 z) {
  return _mm256_add_ps(_mm256_add_ps(_mm256_mul_ps(a, x), _mm256_mul_ps(b, y)),
                       _mm256_mul_ps(c, z));
}

inline __m256 atLeast(__m256 a, __m256 b) {
  return _mm256_cmp_ps(a, b, _CMP_GE_OQ);
}

/// Writes the lanes of `order` first; those behind them are overwritten by the next.
inline void put(float* to, __m256 values, __m256i order) {
  _mm256_storeu_ps(to, _mm256_permutevar8x32_ps(values, order));
}

}  // namespace

int projectAvx2(const ProjectColumns& columns, int count, const ProjectCamera& camera,
                const ProjectOutput& out) {
  const Camera8 c(camera);
  const __m256 zero = _mm256_setzero_ps();
  const __m256 sign = _mm256_set1_ps(-0.F);
  int visible = 0;
  int i = 0;
  for (; i + 8 <= count; i += 8) {
    const __m256 dx = _mm256_sub_ps(_mm256_loadu_ps(columns.x_m + i), c.position[0]);
    const __m256 dy = _mm256_sub_ps(_mm256_loadu_ps(columns.y_m + i), c.position[1]);
    const __m256 image_dz = _mm256_sub_ps(_mm256_loadu_ps(columns.image_z_m + i), c.position[2]);
    const __m256 u = dot(c.rows[0], c.rows[1], c.rows[2], dx, dy, image_dz);
    const __m256 v = dot(c.rows[3], c.rows[4], c.rows[5], dx, dy, image_dz);
    const __m256 w = dot(c.rows[6], c.rows[7], c.rows[8], dx, dy, image_dz);
    const __m256 horizontal2 = _mm256_add_ps(_mm256_mul_ps(dx, dx), _mm256_mul_ps(dy, dy));
    const __m256 image2 = _mm256_add_ps(horizontal2, _mm256_mul_ps(image_dz, image_dz));
    __m256 keep = _mm256_and_ps(
        _mm256_cmp_ps(w, zero, _CMP_GT_OQ),
        _mm256_cmp_ps(_mm256_mul_ps(w, w), _mm256_mul_ps(c.flattest2, image2), _CMP_GT_OQ));
    keep = _mm256_and_ps(keep, atLeast(u, _mm256_mul_ps(c.left, w)));
    keep = _mm256_and_ps(keep, atLeast(_mm256_mul_ps(c.right, w), u));
    keep = _mm256_and_ps(keep, atLeast(v, _mm256_mul_ps(c.top, w)));
    keep = _mm256_and_ps(keep, atLeast(_mm256_mul_ps(c.bottom, w), v));
    // Neighbours in the map were mostly seen together: the rest is seldom needed, nor fetched.
    if (_mm256_movemask_ps(keep) == 0) continue;

    const __m256 dz = _mm256_sub_ps(_mm256_loadu_ps(columns.z_m + i), c.position[2]);
    const __m256 distance2 = _mm256_add_ps(horizontal2, _mm256_mul_ps(dz, dz));
    const __m256 seen2 = _mm256_loadu_ps(columns.seen_m2 + i);
    keep = _mm256_and_ps(keep, atLeast(distance2, c.nearest2));
    keep = _mm256_and_ps(keep, atLeast(_mm256_mul_ps(c.ratio2, distance2), seen2));
    keep = _mm256_and_ps(keep, _mm256_or_ps(atLeast(_mm256_mul_ps(c.ratio2, seen2), distance2),
                                            _mm256_cmp_ps(seen2, zero, _CMP_EQ_OQ)));
    const __m256 along =
        dot(_mm256_loadu_ps(columns.view_x + i), _mm256_loadu_ps(columns.view_y + i),
            _mm256_loadu_ps(columns.view_z + i), dx, dy, dz);
    keep = _mm256_and_ps(keep, atLeast(_mm256_mul_ps(along, _mm256_andnot_ps(sign, along)),
                                       _mm256_mul_ps(c.cosine2, distance2)));
    const auto mask = static_cast<unsigned>(_mm256_movemask_ps(keep));
    const __m256i order =
        _mm256_cvtepu8_epi32(_mm_cvtsi64_si128(static_cast<long long>(kCompact.lanes[mask])));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(out.index + visible),
                        _mm256_add_epi32(order, _mm256_set1_epi32(i)));
    put(out.x_px + visible, _mm256_div_ps(u, w), order);
    put(out.y_px + visible, _mm256_div_ps(v, w), order);
    put(out.distance_m + visible, _mm256_sqrt_ps(distance2), order);
    visible += __builtin_popcount(mask);
  }
  for (; i < count; ++i) visible = projectOne(columns, i, camera, out, visible);
  return visible;
}

}  // namespace ardrone_vslam::kernels
