// SPDX-License-Identifier: BSD-3-Clause
// Cross-compiled for ARM and run under emulation: no test library there.
#include <algorithm>
#include <cstdio>

#include "kernels/fast/fast_kernels.hpp"
#include "support/grey_images.hpp"

namespace ardrone_vslam::test {
namespace {

using namespace kernels;

constexpr int kNeonGroup_px = 16;

struct ScannedRow {
  std::vector<std::uint8_t> scores;
  std::vector<std::uint16_t> groups;
};

ScannedRow scan(decltype(&fastRowScalar) fastRow, const GreyImage& image, const FastRow& row,
                int arc) {
  ScannedRow result;
  result.scores.assign(static_cast<std::size_t>(image.width() + kScorePadding), 0);
  result.groups.resize(result.scores.size());
  const int count = fastRow(row, fastCircle(image.view().stride_bytes, arc),
                            {result.scores.data(), result.groups.data()});
  result.groups.resize(static_cast<std::size_t>(count));
  return result;
}

/// Whether all corners lie in the groups.
bool groupsHoldAll(ScannedRow row) {
  for (const std::uint16_t x : row.groups)
    std::fill_n(row.scores.begin() + x, kNeonGroup_px, std::uint8_t{0});
  return std::count(row.scores.begin(), row.scores.end(), 0) ==
         static_cast<std::ptrdiff_t>(row.scores.size());
}

std::vector<std::uint16_t> maxima(decltype(&fastMaximaScalar) fastMaxima,
                                  const std::vector<ScannedRow>& rows, std::size_t y,
                                  bool later_may_equal) {
  std::vector<std::uint16_t> columns(rows[y].scores.size());
  const int count =
      fastMaxima({rows[y - 1].scores.data(), rows[y].scores.data(), rows[y + 1].scores.data(),
                  rows[y].groups.data(), static_cast<int>(rows[y].groups.size()), later_may_equal},
                 columns.data());
  columns.resize(static_cast<std::size_t>(count));
  return columns;
}

std::vector<std::uint16_t> listed(decltype(&fastListScalar) fastList, const ScannedRow& row) {
  std::vector<std::uint16_t> columns(row.scores.size());
  const int count = fastList(row.scores.data(), row.groups.data(),
                             static_cast<int>(row.groups.size()), columns.data());
  columns.resize(static_cast<std::size_t>(count));
  return columns;
}

/// Number of corners in an image; adds what differs to `faults`.
int compare(const GreyImage& image, int arc, unsigned columns, std::mt19937& random, int& faults) {
  std::vector<std::uint8_t> thresholds(static_cast<std::size_t>(image.width()));
  for (auto& threshold : thresholds)
    threshold = static_cast<std::uint8_t>(uniformInt(random, 1, 90));
  int corners = 0;
  std::vector<ScannedRow> expected;
  std::vector<ScannedRow> found;
  for (int y = 3; y < image.height() - 3; ++y) {
    const FastRow row{image.view().row(y), thresholds.data(), 3, image.width() - 3, columns};
    expected.push_back(scan(fastRowScalar, image, row, arc));
    found.push_back(scan(fastRowNeon, image, row, arc));
    corners += static_cast<int>(expected.back().groups.size());
    if (found.back().scores == expected.back().scores && groupsHoldAll(found.back())) continue;
    std::printf("fastRowNeon differs: width %d, s %d, columns %u, row %d\n", image.width(), arc,
                columns, y);
    ++faults;
  }
  for (std::size_t y = 0; y < expected.size(); ++y) {
    if (listed(fastListNeon, found[y]) == listed(fastListScalar, expected[y])) continue;
    std::printf("fastListNeon differs: width %d, s %d\n", image.width(), arc);
    ++faults;
  }
  for (std::size_t y = 1; y + 1 < expected.size(); ++y) {
    for (const bool later_may_equal : {false, true}) {
      if (maxima(fastMaximaNeon, found, y, later_may_equal) ==
          maxima(fastMaximaScalar, expected, y, later_may_equal))
        continue;
      std::printf("fastMaximaNeon differs: width %d, s %d\n", image.width(), arc);
      ++faults;
    }
  }
  return corners;
}

}  // namespace

/// @return number of faults
int testFastNeon() {
  int faults = 0;
  int corners = 0;
  std::mt19937 random(21);
  for (int width = 7; width < 7 + 5 * kNeonGroup_px; ++width) {
    for (const GreyImage& image : imagesOfSize(width, 11, random)) {
      for (int arc = 9; arc <= 12; ++arc) {
        for (const unsigned columns : {0xFU, static_cast<unsigned>(uniformInt(random, 0, 15))})
          corners += compare(image, arc, columns, random, faults);
      }
    }
  }
  if (corners < 1000) {
    std::printf("fastRowNeon: hardly a corner was found, the test says nothing\n");
    ++faults;
  }
  return faults;
}

}  // namespace ardrone_vslam::test
