// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "ardrone_vslam/features.hpp"
#include "kernels/kernels.hpp"
#include "support/grey_images.hpp"

// The row kernels of FAST with their buffers and the promises that hold for every form.
namespace ardrone_vslam::test {

inline std::string nameOf(InstructionSet set) {
  return EnumNames<InstructionSet>::kNames[static_cast<std::size_t>(set)];
}

struct ScannedRow {
  std::vector<std::uint8_t> scores;  ///< followed by the padding
  std::vector<std::uint16_t> groups;
};

inline ScannedRow scan(const kernels::Kernels& kernels, const GreyImage& image,
                       const kernels::FastRow& row, int arc) {
  const auto circle = kernels::fastCircle(image.view().stride_bytes, arc);
  ScannedRow result;
  result.scores.assign(static_cast<std::size_t>(image.width() + kernels::kScorePadding), 0);
  result.groups.assign(static_cast<std::size_t>(std::max(0, row.x_end_px - row.x_begin_px) + 1),
                       0xABCDU);
  const int count = kernels.fast_row(row, circle, {result.scores.data(), result.groups.data()});
  EXPECT_EQ(result.groups.back(), 0xABCDU) << "written beyond the room for groups";
  result.groups.resize(static_cast<std::size_t>(count));
  return result;
}

/// @return the score of each column. Fails where the groups do not hold all corners, ascending.
inline std::vector<std::uint8_t> scanned(const kernels::Kernels& kernels, const GreyImage& image,
                                         const kernels::FastRow& row, int arc) {
  ScannedRow result = scan(kernels, image, row, arc);
  EXPECT_TRUE(std::is_sorted(result.groups.begin(), result.groups.end()));
  std::vector<std::uint8_t> outside = result.scores;
  for (const std::uint16_t x : result.groups)
    std::fill_n(outside.begin() + x, kernels.fast_group_px, std::uint8_t{0});
  EXPECT_EQ(std::count(outside.begin(), outside.end(), 0),
            static_cast<std::ptrdiff_t>(outside.size()))
      << "corners outside of the groups";
  result.scores.resize(static_cast<std::size_t>(image.width()));
  return result.scores;
}

/// Place, order and score.
inline void expectSameCorners(const std::vector<Corner>& corners,
                              const std::vector<Corner>& expected, InstructionSet set) {
  const bool same = std::equal(corners.begin(), corners.end(), expected.begin(), expected.end(),
                               [](const Corner& a, const Corner& b) {
                                 return a.x_px == b.x_px && a.y_px == b.y_px && a.score == b.score;
                               });
  EXPECT_TRUE(same) << nameOf(set) << " " << corners.size() << " corners, " << expected.size()
                    << " expected";
}

}  // namespace ardrone_vslam::test
