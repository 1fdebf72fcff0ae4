// SPDX-License-Identifier: BSD-3-Clause
#include "alignment/view_change.hpp"

#include <cmath>
#include <cstddef>

namespace ardrone_vslam {
namespace {

/// A similarity, and how far the tracks are from it.
struct Fit {
  ViewChange change;
  Eigen::Vector2f shift_px = Eigen::Vector2f::Zero();
  float scale_px2 = INFINITY;  ///< beyond it tracks count less and less
};

Fit betterFit(const std::vector<TrackMove>& moves, const Fit& fit) {
  float weights = 0;
  float rest_px2 = 0;
  Eigen::Vector2f before_px = Eigen::Vector2f::Zero();
  Eigen::Vector2f now_px = Eigen::Vector2f::Zero();
  float squared_px2 = 0;
  float along_px2 = 0;
  float across_px2 = 0;
  for (const TrackMove& move : moves) {
    const Eigen::Vector2f& b = move.before_px;
    const Eigen::Vector2f& n = move.now_px;
    const float distance_px2 = (n - fit.change * b - fit.shift_px).squaredNorm();
    const float ratio = 1 + distance_px2 / fit.scale_px2;
    const float weight = 1 / (ratio * ratio);
    weights += weight;
    rest_px2 += weight * distance_px2;
    before_px += weight * b;
    now_px += weight * n;
    squared_px2 += weight * b.squaredNorm();
    along_px2 += weight * b.dot(n);
    across_px2 += weight * (b.x() * n.y() - b.y() * n.x());
  }
  // About the middle of the tracks.
  const Eigen::Vector2f middle_px = before_px / weights;
  squared_px2 -= middle_px.dot(before_px);
  along_px2 -= middle_px.dot(now_px);
  across_px2 -= middle_px.x() * now_px.y() - middle_px.y() * now_px.x();
  constexpr float kLeast_px2 = 0.5F;  // corners lie on whole pixels
  Fit better;
  better.change = {along_px2 / squared_px2, across_px2 / squared_px2};
  better.shift_px = now_px / weights - better.change * middle_px;
  better.scale_px2 = 2 * rest_px2 / weights + kLeast_px2;
  return better;
}

}  // namespace

Eigen::Vector2f ViewChange::operator*(const Eigen::Vector2f& offset_px) const {
  return {along * offset_px.x() - across * offset_px.y(),
          across * offset_px.x() + along * offset_px.y()};
}

ViewChange ViewChange::operator*(const ViewChange& before) const {
  return {along * before.along - across * before.across,
          along * before.across + across * before.along};
}

ViewChange ViewChange::inverse() const {
  const float growth2 = along * along + across * across;
  return {along / growth2, -across / growth2};
}

float ViewChange::growth() const {
  return std::sqrt(along * along + across * across);
}

float ViewChange::differenceFrom(const ViewChange& other) const {
  return ViewChange{along - other.along, across - other.across}.growth() / other.growth();
}

ViewChange commonViewChange(const std::vector<TrackMove>& moves) {
  constexpr std::size_t kFewest = 8;
  constexpr int kPasses = 5;
  constexpr float kMost = 0.5F;
  if (moves.size() < kFewest) return {};
  Fit fit;
  for (int i = 0; i < kPasses; ++i) fit = betterFit(moves, fit);
  // Also false of what is not a number: tracks all in one place.
  return fit.change.differenceFrom({}) < kMost ? fit.change : ViewChange{};
}

}  // namespace ardrone_vslam
