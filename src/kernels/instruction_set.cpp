// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/instruction_set.hpp"

#include <cstdlib>

namespace ardrone_vslam {

std::vector<InstructionSet> supportedInstructionSets() {
  std::vector<InstructionSet> sets{InstructionSet::kScalar};
#ifdef ARDRONE_VSLAM_WITH_NEON
  sets.push_back(InstructionSet::kNeon);  // without it the program would not have been built so
#endif
#ifdef ARDRONE_VSLAM_WITH_AVX2
  // All that the kernels' files are compiled for: virtual machines may hide one of them.
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi") &&
      __builtin_cpu_supports("bmi2") && __builtin_cpu_supports("popcnt")) {
    sets.push_back(InstructionSet::kAvx2);
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
        __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512vbmi") &&
        __builtin_cpu_supports("avx512vpopcntdq")) {
      sets.push_back(InstructionSet::kAvx512);
    }
  }
#endif
  return sets;
}

InstructionSetChoice chooseInstructionSet(const char* request) {
  const auto sets = supportedInstructionSets();
  const std::string name = request == nullptr ? "" : request;
  if (name.empty()) return {sets.back(), ""};
  std::string names;
  for (const InstructionSet set : sets) {
    if (name == nameOf(set)) return {set, ""};
    names += std::string(names.empty() ? "" : ", ") + nameOf(set);
  }
  return {sets.back(), "ARDRONE_VSLAM_KERNELS: '" + name + "' is not to be had here; " +
                           nameOf(sets.back()) + " is used. Choose one of: " + names};
}

const InstructionSetChoice& instructionSetInUse() {
  static const InstructionSetChoice choice =
      chooseInstructionSet(std::getenv("ARDRONE_VSLAM_KERNELS"));
  return choice;
}

}  // namespace ardrone_vslam
