// SPDX-License-Identifier: BSD-3-Clause
#include "kernels/kernels.hpp"

namespace ardrone_vslam::kernels {

Kernels kernelsFor(InstructionSet set) {
  Kernels kernels;
  static_cast<void>(set);
#ifdef ARDRONE_VSLAM_WITH_AVX2
  if (set == InstructionSet::kAvx2 || set == InstructionSet::kAvx512) {
    // FAST with the 64 lanes of AVX-512 was measured: no faster on 1242x375 px, slower on 320x240.
    kernels.fast_row = fastRowAvx2;
    kernels.fast_group_px = 32;
    kernels.fast_maxima = fastMaximaAvx2;
    kernels.fast_list = fastListAvx2;
    kernels.freak_integral16 = freakIntegral16Avx2;
    kernels.freak_means = freakMeansAvx2;
    kernels.freak_orientation = freakOrientationAvx2;
    kernels.freak_bits = freakBitsAvx2;
    kernels.hamming_nearest = hammingNearestAvx2;
    kernels.hamming_mutual = hammingMutualAvx2;
    kernels.hamming_distances = hammingDistancesAvx2;
    kernels.hamming_window = hammingWindowAvx2;
    kernels.project = projectAvx2;
    kernels.product_tile = productTileAvx2;
    // Four rows in a vector of AVX-512 were measured: 8 % slower than two of AVX2.
    kernels.align = alignAvx2;
  }
  if (set == InstructionSet::kAvx512) {
    kernels.freak_bits = freakBitsAvx512;
    kernels.hamming_nearest = hammingNearestAvx512;
    kernels.hamming_mutual = hammingMutualAvx512;
    kernels.hamming_distances = hammingDistancesAvx512;
    kernels.project = projectAvx512;
    kernels.hamming_window = hammingWindowAvx512;
  }
#endif
#ifdef ARDRONE_VSLAM_WITH_NEON
  if (set == InstructionSet::kNeon) {
    kernels.fast_row = fastRowNeon;
    kernels.fast_group_px = 16;
    kernels.fast_maxima = fastMaximaNeon;
    kernels.fast_list = fastListNeon;
    kernels.freak_integral16 = freakIntegral16Neon;
    kernels.freak_means = freakMeansNeon;
    kernels.freak_orientation = freakOrientationNeon;
    kernels.freak_bits = freakBitsNeon;
    kernels.hamming_nearest = hammingNearestNeon;
    kernels.hamming_mutual = hammingMutualNeon;
    kernels.hamming_distances = hammingDistancesNeon;
    kernels.hamming_window = hammingWindowNeon;
    kernels.project = projectNeon;
    kernels.product_tile = productTileNeon;
    kernels.align = alignNeon;
  }
#endif
  return kernels;
}

const Kernels& kernelsInUse() {
  static const Kernels kernels = kernelsFor(instructionSetInUse().set);
  return kernels;
}

}  // namespace ardrone_vslam::kernels
