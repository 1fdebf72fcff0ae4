// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iostream>
#include <random>
#include <vector>

namespace ardrone_vslam::test {

/// Three that are always the same, and one that is new in every run and printed.
inline std::vector<std::uint64_t> seeds() {
  const std::uint64_t fresh = std::random_device{}();
  std::cout << "random seed " << fresh << '\n';
  return {1, 2, 3, fresh};
}

}  // namespace ardrone_vslam::test
