// SPDX-License-Identifier: BSD-3-Clause
#include "kernels/kernels.hpp"

namespace ardrone_vslam::kernels {

Kernels kernelsFor(InstructionSet set) {
  Kernels kernels;
  static_cast<void>(set);
  return kernels;
}

const Kernels& kernelsInUse() {
  static const Kernels kernels = kernelsFor(instructionSetInUse().set);
  return kernels;
}

}  // namespace ardrone_vslam::kernels
