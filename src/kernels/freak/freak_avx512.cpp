// SPDX-License-Identifier: BSD-3-Clause
#include <immintrin.h>

#include "kernels/freak/freak_kernels.hpp"

namespace ardrone_vslam::kernels {
namespace {

/// The means of 64 listed fields: one look-up, as all means fit one vector.
__m512i look(__m512i means, const std::uint8_t* fields) {
  // The form without a mask is warned of by GCC 12: its header names an uninitialised vector.
  return _mm512_maskz_permutexvar_epi8(~__mmask64{0}, _mm512_loadu_si512(fields), means);
}

}  // namespace

void freakBitsAvx512(const std::uint8_t* means, const FreakComparisons& lists,
                     std::uint64_t* words) {
  constexpr __mmask64 kAll = (1ULL << kFreakPaddedFields) - 1;
  const __m512i table = _mm512_maskz_loadu_epi8(kAll, means);
  for (int w = 0; w < kFreakComparisons / 64; ++w) {
    words[w] = _mm512_cmpge_epu8_mask(look(table, lists.first_in_order + 64 * w),
                                      look(table, lists.second_in_order + 64 * w));
  }
}

}  // namespace ardrone_vslam::kernels
