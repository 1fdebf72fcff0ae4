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

/// The last keyframe that is not after it, or the first.
std::size_t keyframeOf(const MapAnchor& anchor, const FlightRecord& record) {
  const auto& keyframes = record.keyframes;
  const auto after = std::upper_bound(
      keyframes.begin(), keyframes.end(), anchor.stamp_ns,
      [](std::int64_t stamp_ns, const Keyframe& keyframe) { return stamp_ns < keyframe.stamp_ns; });
  const auto count = static_cast<std::size_t>(after - keyframes.begin());
  return count == 0 ? 0 : count - 1;
}

}  // namespace

Refinement refine(const FlightRecord& record, const std::vector<MapAnchor>& anchors,
                  const RefinementProgress& progress) {
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
  std::vector<std::size_t> of_anchors;
  of_anchors.reserve(anchors.size());
  for (const MapAnchor& anchor : anchors) of_anchors.push_back(keyframeOf(anchor, record));
  if (!anchors.empty()) refined.anchor_covariance = bundle.covariance(of_anchors);
  refined.views = bundle.views();
  refined.views_left_out = bundle.dropped();
  return refined;
}

}  // namespace ardrone_vslam
