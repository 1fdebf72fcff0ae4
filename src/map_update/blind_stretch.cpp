// SPDX-License-Identifier: BSD-3-Clause
#include "map_update/blind_stretch.hpp"

#include <Eigen/LU>
#include <algorithm>

#include "window/map_entry.hpp"

namespace ardrone_vslam {

AcrossBlind BlindStretch::judge(const MapFix& fix, const std::vector<MapObservation>& seen,
                                WindowState& state) {
  const auto before = std::count_if(seen.begin(), seen.end(), [&](const MapObservation& s) {
    return isAfter(state.anchors()[s.anchor]);
  });
  if (2 * static_cast<std::size_t>(before) <= seen.size()) return AcrossBlind::kAsUsual;
  // The odometry often drifts by more than it claims where nothing is seen: five sigmas.
  constexpr double kMost = 12.6;  // chi-square of a pose, 95 %
  constexpr double kMoreOfBlind = 6 * 5 * 5 / kMost - 1;
  const Matrix6d of_blind = kMoreOfBlind * drift(state);
  const Matrix6d S = fix.drift + fix.covariance + of_blind;
  const bool is_explained = fix.offset.dot(S.inverse() * fix.offset) < kMost;
  const std::int64_t to_ns = to_ns_;
  if (!judge(state.newest().stamp_ns, is_explained)) return AcrossBlind::kContradicts;
  if (!is_explained || fix.distance() < kMost) return AcrossBlind::kAsUsual;
  MapEntrance(state).doubtSince(to_ns, of_blind);
  forget();
  return AcrossBlind::kWidened;
}

bool BlindStretch::judge(std::int64_t stamp_ns, bool is_explained) {
  constexpr double kSure_s = 3;  // wrong landmarks agree for some images
  constexpr double kGap_s = 1;
  if (!is_explained || agreed_from_ns_ == 0 || seconds(stamp_ns - agreed_ns_) > kGap_s)
    agreed_from_ns_ = is_explained ? stamp_ns : 0;
  agreed_ns_ = stamp_ns;
  const bool is_sure = is_explained && seconds(stamp_ns - agreed_from_ns_) > kSure_s;
  if (is_sure || seconds(stamp_ns - to_ns_) > kRevisitTakes_s) forget();
  return is_explained || from_ns_ == 0;
}

/// Covariance of the way meanwhile: position, attitude. From the last pose before that is in the
/// state, or from map's origin; to the first one after.
Matrix6d BlindStretch::drift(const WindowState& state) const {
  const auto& frames = state.frames();
  const auto& anchors = state.anchors();
  std::size_t after = 0;
  while (after + 1 < frames.size() && frames[after].stamp_ns < to_ns_) ++after;
  const int to = state.frameCoordinate(after);
  for (std::size_t i = after; i-- > 0;)
    if (frames[i].stamp_ns < from_ns_)
      return state.relativeCovariance(to, state.frameCoordinate(i));
  for (std::size_t i = anchors.size(); i-- > 0;)
    if (!anchors[i].is_loaded && anchors[i].stamp_ns < from_ns_)
      return state.relativeCovariance(to, state.anchorCoordinate(i));
  return state.covariance().block<6, 6>(to, to);
}

}  // namespace ardrone_vslam
