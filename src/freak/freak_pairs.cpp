// SPDX-License-Identifier: BSD-3-Clause
#include "freak/freak_pairs.hpp"

#include <array>
#include <cmath>
#include <vector>

#include "freak/freak_selected_pairs.hpp"

namespace ardrone_vslam {
namespace {

constexpr int kOuterRings = 4;   // these vote for the orientation by 9 pairs each
constexpr int kVotingRings = 7;  // the others of these by 3

}  // namespace

kernels::FreakOrientationPairs orientationPairsOf(const FreakField* fields) {
  using Pair = std::array<int, 2>;
  // Points of one ring. The inner rings vote with the opposite ones only, which come first.
  constexpr std::array<Pair, 9> kRingPairs{Pair{0, 3}, Pair{1, 4}, Pair{2, 5},
                                           Pair{0, 2}, Pair{1, 3}, Pair{2, 4},
                                           Pair{3, 5}, Pair{4, 0}, Pair{5, 1}};
  kernels::FreakOrientationPairs pairs{};
  int count = 0;
  for (int ring = 0; ring < kVotingRings; ++ring) {
    const std::size_t pairs_of_ring = ring < kOuterRings ? 9 : 3;
    for (std::size_t k = 0; k < pairs_of_ring; ++k) {
      const int i = kFreakPointsPerRing * ring + kRingPairs[k][0];
      const int j = kFreakPointsPerRing * ring + kRingPairs[k][1];
      const FreakField& field_i = fields[i];
      const FreakField& field_j = fields[j];
      const float dx = field_i.x_px - field_j.x_px;
      const float dy = field_i.y_px - field_j.y_px;
      const float norm_squared = dx * dx + dy * dy;
      const auto weight = [norm_squared](float d) {
        return static_cast<std::int16_t>(std::lround(d / norm_squared * 4096.0));
      };
      pairs.i.set(count, i);
      pairs.j.set(count, j);
      pairs.weight_x[count] = weight(dx);
      pairs.weight_y[count] = weight(dy);
      ++count;
    }
  }
  return pairs;
}

kernels::FreakComparisons selectedComparisons() {
  kernels::FreakComparisons comparisons{};
  std::vector<std::array<int, 2>> all_pairs;
  for (int i = 1; i < kernels::kFreakFields; ++i) {
    for (int j = 0; j < i; ++j) all_pairs.push_back({i, j});
  }
  for (int bit = 0; bit < 8; ++bit) {
    for (int byte = 0; byte < kFreakBits / 8; ++byte) {
      // Within 16 bytes the published order runs from the last byte to the first.
      const int selected = 128 * (byte / 16) + 16 * bit + 15 - byte % 16;
      const auto& pair = all_pairs[kFreakSelectedPairs[static_cast<std::size_t>(selected)]];
      comparisons.set(bit, byte, pair[0], pair[1]);
    }
  }
  return comparisons;
}

}  // namespace ardrone_vslam
