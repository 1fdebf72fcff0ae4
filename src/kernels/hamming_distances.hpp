// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kernels/hamming_kernels.hpp"

// Other forms of hammingDistancesScalar; they give the same numbers.
namespace ardrone_vslam::kernels {

void hammingDistancesAvx2(const std::uint64_t* query, const std::uint64_t* train, std::size_t count,
                          std::uint16_t* distances_bits);
void hammingDistancesAvx512(const std::uint64_t* query, const std::uint64_t* train,
                            std::size_t count, std::uint16_t* distances_bits);
void hammingDistancesNeon(const std::uint64_t* query, const std::uint64_t* train, std::size_t count,
                          std::uint16_t* distances_bits);

}  // namespace ardrone_vslam::kernels
