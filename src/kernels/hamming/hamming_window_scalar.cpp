// SPDX-License-Identifier: BSD-3-Clause
#include "kernels/hamming/hamming_window_each.hpp"
#include "kernels/hamming/hamming_words.hpp"

namespace ardrone_vslam::kernels {

void hammingWindowScalar(const HammingWindowEntries& entries, const HammingWindowQuery& query,
                         const HammingRange* ranges, int range_count, HammingNearest& nearest) {
  windowEach(entries, query, ranges, range_count, nearest, [&query](const std::uint64_t* words) {
    return hammingDistance512(query.words, words);
  });
}

}  // namespace ardrone_vslam::kernels
