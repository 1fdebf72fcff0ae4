// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

namespace ardrone_vslam::kernels {

/// Hamming distances of one 512-bit descriptor to `count` others. The scalar form is the
/// definition: the others, of which the files of this machine's architecture define theirs, give
/// the same numbers.
/// @param query  8 words
/// @param train  8 words for each descriptor, one after the other
/// @param distances_bits  `count` distances, 0..512
void hammingDistancesScalar(const std::uint64_t* query, const std::uint64_t* train,
                            std::size_t count, std::uint16_t* distances_bits);
void hammingDistancesAvx2(const std::uint64_t* query, const std::uint64_t* train, std::size_t count,
                          std::uint16_t* distances_bits);
void hammingDistancesAvx512(const std::uint64_t* query, const std::uint64_t* train,
                            std::size_t count, std::uint16_t* distances_bits);
void hammingDistancesNeon(const std::uint64_t* query, const std::uint64_t* train, std::size_t count,
                          std::uint16_t* distances_bits);

}  // namespace ardrone_vslam::kernels
