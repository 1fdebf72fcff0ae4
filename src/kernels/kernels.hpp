// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ardrone_vslam/instruction_set.hpp"
#include "kernels/align/align_kernels.hpp"
#include "kernels/fast/fast_kernels.hpp"
#include "kernels/freak/freak_kernels.hpp"
#include "kernels/hamming/hamming_distances.hpp"
#include "kernels/hamming/hamming_kernels.hpp"
#include "kernels/hamming/hamming_window.hpp"
#include "kernels/product/product_kernels.hpp"
#include "kernels/project/project_kernels.hpp"

namespace ardrone_vslam::kernels {

/// One form of every kernel. Why none of them is a library call: benchmark/RESULTS.md has the
/// factors. Of alignment and products it is not speed but the same bits on every processor.
struct Kernels {
  decltype(&fastRowScalar) fast_row = fastRowScalar;
  int fast_group_px = 1;  ///< columns of a group that fast_row lists
  decltype(&fastMaximaScalar) fast_maxima = fastMaximaScalar;
  decltype(&fastListScalar) fast_list = fastListScalar;
  decltype(&fastTestScalar) fast_test = fastTestScalar;
  decltype(&fastScoreScalar) fast_score = fastScoreScalar;
  decltype(&freakIntegral16Scalar) freak_integral16 = freakIntegral16Scalar;
  decltype(&freakIntegral32Scalar) freak_integral32 = freakIntegral32Scalar;
  decltype(&freakMeansScalar) freak_means = freakMeansScalar;
  decltype(&freakOrientationScalar) freak_orientation = freakOrientationScalar;
  decltype(&freakBitsScalar) freak_bits = freakBitsScalar;
  decltype(&hammingDistancesScalar) hamming_distances = hammingDistancesScalar;
  decltype(&hammingNearestScalar) hamming_nearest = hammingNearestScalar;
  decltype(&hammingMutualScalar) hamming_mutual = hammingMutualScalar;
  decltype(&hammingWindowScalar) hamming_window = hammingWindowScalar;
  decltype(&projectScalar) project = projectScalar;
  decltype(&alignScalar) align = alignScalar;
  decltype(&productTileScalar) product_tile = productTileScalar;
};

/// The fastest form of each kernel that needs no more than `set`, which must be supported here.
Kernels kernelsFor(InstructionSet set);

/// Those for instructionSetInUse().
const Kernels& kernelsInUse();

}  // namespace ardrone_vslam::kernels
