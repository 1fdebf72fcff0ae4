// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernels/hamming/hamming_kernels.hpp"

// Comparison of a query with those of many descriptors that lie in a circle (WindowSearch). The
// scalar form is the definition: every other form gives the same numbers.
namespace ardrone_vslam::kernels {

/// The vector forms read and write so many entries more than a range has; they leave them as they
/// are.
constexpr std::size_t kWindowPadding = 7;

/// Arrays, an element for each entry; 8 words for each.
struct HammingWindowEntries {
  const std::uint64_t* words;
  const float* x_px;
  const float* y_px;
  const std::int32_t* index;  ///< is what is reported; 0 or greater
  /// The query nearest to the entry so far: its distance, kNoDistance_bits: none, and its number.
  std::int32_t* nearest_query_bits;
  std::int32_t* nearest_query;
};

struct HammingWindowQuery {
  const std::uint64_t* words;
  float x_px, y_px;   ///< centre of the circle
  float radius2_px2;  ///< entries at this squared distance are in it
  std::int32_t number;
};

/// Entries begin .. end - 1.
struct HammingRange {
  std::size_t begin, end;
};

/// Offers the entries within the circle to `nearest` and the query to each of them, which it takes
/// if it is nearer than those before.
/// @param ranges  `range_count` of them; no entry is in two
void hammingWindowScalar(const HammingWindowEntries& entries, const HammingWindowQuery& query,
                         const HammingRange* ranges, int range_count, HammingNearest& nearest);

// The other forms; only the files of this machine's architecture define theirs.
void hammingWindowAvx2(const HammingWindowEntries& entries, const HammingWindowQuery& query,
                       const HammingRange* ranges, int range_count, HammingNearest& nearest);
void hammingWindowAvx512(const HammingWindowEntries& entries, const HammingWindowQuery& query,
                         const HammingRange* ranges, int range_count, HammingNearest& nearest);
void hammingWindowNeon(const HammingWindowEntries& entries, const HammingWindowQuery& query,
                       const HammingRange* ranges, int range_count, HammingNearest& nearest);

}  // namespace ardrone_vslam::kernels
