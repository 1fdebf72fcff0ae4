// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace ardrone_vslam {

/// The program's malloc, and with it new and Eigen's matrices: a FixedHeap that grows once. Until
/// takeMemory() it has half a megabyte of its own, for configuration and start.

/// Takes the memory for the whole flight from the system, and touches it, so that nothing is asked
/// for later. Once. @param lock  also keeps all that the program has in memory from being paged out
/// @throws std::runtime_error when the system has not so much
void takeMemory(std::size_t bytes, bool lock);

/// The most that was in use at a time, and all that there is.
struct MemoryUse {
  std::size_t most_bytes;
  std::size_t capacity_bytes;
};
MemoryUse memoryUse();

}  // namespace ardrone_vslam
