// SPDX-License-Identifier: BSD-3-Clause
#include "kernels/hamming/hamming_groups.hpp"
#include "kernels/hamming/hamming_window.hpp"
#include "kernels/hamming/hamming_words.hpp"

namespace ardrone_vslam::kernels {

void hammingWindowScalar(const HammingWindowEntries& entries, const HammingWindowQuery& query,
                         const HammingRange* ranges, int range_count, HammingNearest& nearest) {
  for (const HammingRange* range = ranges; range != ranges + range_count; ++range) {
    for (std::size_t k = range->begin; k < range->end; ++k) {
      const float dx_px = entries.x_px[k] - query.x_px;
      const float dy_px = entries.y_px[k] - query.y_px;
      if (!(dx_px * dx_px + dy_px * dy_px <= query.radius2_px2)) continue;
      const std::int32_t bits = hammingDistance512(query.words, entries.words + 8 * k);
      offer(nearest, entries.index[k], bits);
      if (bits >= entries.nearest_query_bits[k]) continue;
      entries.nearest_query_bits[k] = bits;
      entries.nearest_query[k] = query.number;
    }
  }
}

}  // namespace ardrone_vslam::kernels
