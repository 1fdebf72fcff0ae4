// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ardrone_vslam/features.hpp"
#include "kernels/hamming/hamming_words.hpp"

namespace ardrone_vslam {

/// @return number of bits in which the two descriptors differ, 0..512.
inline int hammingDistance(const DescriptorBits& a, const DescriptorBits& b) {
  return kernels::hammingDistance512(a.words.data(), b.words.data());
}

}  // namespace ardrone_vslam
