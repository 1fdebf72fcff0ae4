// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/hamming.hpp"
#include "kernels/hamming_kernels.hpp"

namespace ardrone_vslam::kernels {

void hammingDistancesScalar(const std::uint64_t* query, const std::uint64_t* train,
                            std::size_t count, std::uint16_t* distances_bits) {
  for (std::size_t k = 0; k < count; ++k) {
    distances_bits[k] =
        static_cast<std::uint16_t>(detail::hammingDistance512(query, train + 8 * k));
  }
}

}  // namespace ardrone_vslam::kernels
