// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <vector>

#include "ardrone_vslam/parameters.hpp"

namespace ardrone_vslam {

/// What the inner loops of detection, description and matching are compiled for. Every form gives
/// the same bytes; scalar is the definition.
enum class InstructionSet { kScalar, kNeon, kAvx2, kAvx512 };
template <>
struct EnumNames<InstructionSet> {
  static constexpr std::array<const char*, 4> kNames{"scalar", "neon", "avx2", "avx512"};
};

/// @return those that this build contains and this processor runs, from scalar to the fastest
std::vector<InstructionSet> supportedInstructionSets();

/// The set that is used, and whether it is the one that was asked for.
struct InstructionSetChoice {
  InstructionSet set = InstructionSet::kScalar;  ///< one of supportedInstructionSets()
  std::string fault;  ///< why the request was not met; empty if it was, or if there was none
};

/// @param request  a name of EnumNames<InstructionSet>, or null or "" for the fastest
/// @return the set asked for; the fastest with a fault if there is none of that name here
InstructionSetChoice chooseInstructionSet(const char* request);

/// The choice by the environment variable ARDRONE_VSLAM_KERNELS, made once at the first call: what
/// the whole process uses.
const InstructionSetChoice& instructionSetInUse();

}  // namespace ardrone_vslam
