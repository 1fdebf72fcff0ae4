// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

namespace ardrone_vslam {

constexpr int kFreakBits = 512;

/// The published selection of FREAK (Alahi, Ortiz, Vandergheynst 2012): which pairs of fields are
/// compared, coarse to fine in blocks of 128. Each entry is an index into the list of all pairs (i,
/// j), i = 1..42, j = 0..i-1 in that order. Learned by the authors from image data, so it cannot be
/// computed; every compatible FREAK uses these numbers.
extern const std::array<std::uint16_t, kFreakBits> kFreakSelectedPairs;

}  // namespace ardrone_vslam
