// SPDX-License-Identifier: BSD-3-Clause
#include "alignment/view_change.hpp"

#include <cmath>
#include <cstddef>

namespace ardrone_vslam {
namespace {

/// A similarity, and how far the tracks are from it.
struct Fit {
  ViewChange change = kSameView;
  std::complex<float> shift_px;
  float scale_px2 = INFINITY;  ///< beyond it tracks count less and less
};

Fit betterFit(const std::vector<TrackMove>& moves, const Fit& fit) {
  float weights = 0;
  float rest_px2 = 0;
  float squared_px2 = 0;
  std::complex<float> before_px;
  std::complex<float> now_px;
  std::complex<float> product_px2;
  for (const auto& [before, now] : moves) {
    const float distance_px2 = squareOf(now - fit.change * before - fit.shift_px);
    const float ratio = 1 + distance_px2 / fit.scale_px2;
    const float weight = 1 / (ratio * ratio);
    weights += weight;
    rest_px2 += weight * distance_px2;
    squared_px2 += weight * squareOf(before);
    before_px += weight * before;
    now_px += weight * now;
    product_px2 += weight * (std::conj(before) * now);
  }
  constexpr float kLeast_px2 = 0.5F;  // corners lie on whole pixels
  const std::complex<float> middle_px = before_px / weights;
  Fit better;
  better.change =
      (product_px2 - std::conj(middle_px) * now_px) / (squared_px2 - weights * squareOf(middle_px));
  better.shift_px = now_px / weights - better.change * middle_px;
  better.scale_px2 = 2 * rest_px2 / weights + kLeast_px2;
  return better;
}

}  // namespace

ViewChange commonViewChange(const std::vector<TrackMove>& moves) {
  constexpr std::size_t kFewest = 8;  // two would do, if none were wrong
  constexpr int kPasses = 5;
  constexpr float kMost = 0.5F;  // half as large again, or 29 degrees: no next image
  if (moves.size() < kFewest) return kSameView;
  Fit fit;
  for (int i = 0; i < kPasses; ++i) fit = betterFit(moves, fit);
  // Also false of what is not a number: tracks all in one place.
  return differenceOf(fit.change, kSameView) < kMost ? fit.change : kSameView;
}

}  // namespace ardrone_vslam
