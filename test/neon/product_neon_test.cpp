// SPDX-License-Identifier: BSD-3-Clause
// Cross-compiled for ARM and run under emulation: no test library there.
#include <cstdio>
#include <cstring>
#include <random>
#include <vector>

#include "kernels/product/product_kernels.hpp"

namespace ardrone_vslam::test {

/// @return number of faults
int testProductNeon() {
  using kernels::kTileColumns;
  using kernels::kTileRows;
  int faults = 0;
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(-1.F, 1.F);
  for (int terms = 0; terms < 200; ++terms) {
    std::vector<float> a(static_cast<std::size_t>(kTileRows * terms) + 1);
    std::vector<float> b(static_cast<std::size_t>(kTileColumns * terms) + 1);
    for (float& value : a) value = uniform(random);
    for (float& value : b) value = uniform(random);
    float expected[kTileRows * kTileColumns];
    float found[kTileRows * kTileColumns];
    kernels::productTileScalar(a.data(), b.data(), terms, expected);
    kernels::productTileNeon(a.data(), b.data(), terms, found);
    if (std::memcmp(expected, found, sizeof expected) == 0) continue;
    std::printf("productTileNeon differs from productTileScalar: %d terms\n", terms);
    ++faults;
  }
  return faults;
}

}  // namespace ardrone_vslam::test
