// SPDX-License-Identifier: BSD-3-Clause
#include "refine/refinement.hpp"

#include <algorithm>
#include <array>

#include "refine/bundle.hpp"

namespace ardrone_vslam {
namespace {

// Off by so many sigmas, a view counts less. Loops that the flight did not close are off by more at
// first, so that the bound comes down step by step.
constexpr std::array<double, 3> kBounds{30, 8, 2.5};
constexpr double kMostSigmas = 4;  // beyond it a view is of another point

}  // namespace

Refinement refine(const FlightRecord& record, const RefinementProgress& progress) {
  Refinement refined;
  if (record.keyframes.empty()) return refined;
  constexpr double kUsualIterations = 40;
  int steps = 0;
  const auto step = [&] {
    ++steps;
    if (progress) progress(std::min(steps / kUsualIterations, 1.0));
  };
  Bundle bundle(record);
  for (const double bound : kBounds) bundle.solve(bound, step);
  bundle.drop(kMostSigmas);
  bundle.solve(kBounds.back(), step);
  for (std::size_t k = 0; k < record.keyframes.size(); ++k)
    refined.T_map_base.push_back(bundle.T_map_base(k));
  refined.points = bundle.points();
  refined.views = bundle.views();
  refined.views_left_out = bundle.dropped();
  return refined;
}

}  // namespace ardrone_vslam
