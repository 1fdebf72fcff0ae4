// SPDX-License-Identifier: BSD-3-Clause
#include "kernels/kernels.hpp"

namespace ardrone_vslam::kernels {

Kernels kernelsFor(InstructionSet set) {
  Kernels kernels;
  static_cast<void>(set);
#ifdef ARDRONE_VSLAM_WITH_AVX2
  if (set == InstructionSet::kAvx2 || set == InstructionSet::kAvx512) {
    kernels.fast_row = fastRowAvx2;
  }
#endif
#ifdef ARDRONE_VSLAM_WITH_NEON
  if (set == InstructionSet::kNeon) {
    kernels.fast_row = fastRowNeon;
  }
#endif
  return kernels;
}

const Kernels& kernelsInUse() {
  static const Kernels kernels = kernelsFor(instructionSetInUse().set);
  return kernels;
}

}  // namespace ardrone_vslam::kernels
