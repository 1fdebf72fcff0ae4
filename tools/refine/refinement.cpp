// SPDX-License-Identifier: BSD-3-Clause
#include "refine/refinement.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <stdexcept>
#include <string>

#include "refine/bundle.hpp"

namespace ardrone_vslam {
namespace {

// Off by so many sigmas, a view counts less. Loops that the flight did not close are off by more at
// first, so that the bound comes down step by step.
constexpr std::array<double, 3> kBounds{30, 8, 2.5};
constexpr double kMostSigmas = 4;             // beyond it a view is of another point
constexpr std::size_t kFewestInKeyframe = 6;  // views on average; with less the odometry is all
// How well they are known takes their cube, and 1.1 GB for 1000.
constexpr std::size_t kMostKnown = 1500;

/// The last keyframe that is not after it, or the first.
std::size_t keyframeOf(const MapAnchor& anchor, const FlightRecord& record) {
  const auto& keyframes = record.keyframes;
  const auto after = std::upper_bound(
      keyframes.begin(), keyframes.end(), anchor.stamp_ns,
      [](std::int64_t stamp_ns, const Keyframe& keyframe) { return stamp_ns < keyframe.stamp_ns; });
  const auto count = static_cast<std::size_t>(after - keyframes.begin());
  return count == 0 ? 0 : count - 1;
}

/// How well anchors, which err as their keyframes, and extrinsics are known, where it can be told.
void addCovariance(const std::vector<MapAnchor>& anchors, const FlightRecord& record,
                   Bundle& bundle, Refinement& refined) {
  constexpr Eigen::Index kPose = 6;
  std::map<std::size_t, Eigen::Index> column_of;
  std::vector<std::size_t> keyframes;
  const auto rows = SavedMap::kAnchor * static_cast<Eigen::Index>(anchors.size());
  Eigen::MatrixXd J =
      Eigen::MatrixXd::Zero(rows, 1 + kPose * static_cast<Eigen::Index>(anchors.size()));
  Eigen::Index row = 0;
  for (const MapAnchor& anchor : anchors) {
    const std::size_t k = keyframeOf(anchor, record);
    const auto next = 1 + kPose * static_cast<Eigen::Index>(keyframes.size());
    const auto [found, is_new] = column_of.emplace(k, next);
    if (is_new) keyframes.push_back(k);
    J.block<kPose, kPose>(row, found->second).setIdentity();
    J(row + kPose, 0) = 1;  // all distances are too long by the odometry's scale error
    row += SavedMap::kAnchor;
  }
  try {
    const Eigen::MatrixXd P = bundle.covariance(keyframes);
    const auto known = 1 + kPose * static_cast<Eigen::Index>(keyframes.size());
    refined.anchor_covariance =
        J.leftCols(known) * P.topLeftCorner(known, known) * J.leftCols(known).transpose();
    if (P.cols() > known) refined.extrinsics_sigma_rad = P.diagonal().tail<3>().cwiseSqrt();
  } catch (const std::runtime_error&) {
    refined.anchor_covariance.resize(0, 0);
  }
}

}  // namespace

Refinement refine(const FlightRecord& record, const std::vector<MapAnchor>& anchors,
                  const RefinementProgress& progress) {
  Refinement refined;
  if (record.keyframes.empty()) return refined;
  constexpr double kUsualIterations = 40;
  constexpr double kSolved = 0.9;  // of the work, before it is asked how well all is known
  int steps = 0;
  const auto step = [&] {
    ++steps;
    if (progress) progress(std::min(steps / kUsualIterations, kSolved));
  };
  Bundle bundle(record);
  for (const double bound : kBounds) bundle.solve(bound, step);
  bundle.drop(kMostSigmas);
  bundle.solve(kBounds.back(), step);
  for (std::size_t k = 0; k < record.keyframes.size(); ++k) {
    refined.T_map_base.push_back(bundle.T_map_base(k));
    refined.R_base_rig.push_back(bundle.R_base_rig(k));
  }
  refined.points = bundle.points();
  refined.views = bundle.views();
  refined.views_left_out = bundle.dropped();
  if (refined.views < kFewestInKeyframe * record.keyframes.size())
    throw std::runtime_error("only " + std::to_string(refined.views) + " views of " +
                             std::to_string(record.keyframes.size()) +
                             " keyframes agree, which is too few to refine anything");
  if (!anchors.empty() && record.keyframes.size() <= kMostKnown)
    addCovariance(anchors, record, bundle, refined);
  if (progress) progress(1);
  return refined;
}

}  // namespace ardrone_vslam
