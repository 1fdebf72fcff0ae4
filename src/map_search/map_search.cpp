// SPDX-License-Identifier: BSD-3-Clause
#include "map_search/map_search.hpp"

#include <cmath>
#include <utility>

#include "ardrone_vslam/rotation.hpp"
#include "linear/scalars.hpp"

namespace ardrone_vslam {
namespace {

// Images of one moment show the same, right or wrong: an observation counts only so long after
// another.
constexpr double kBetweenLooks_s = 0.2;
// A landmark is known again from so many times the distance that it was seen from.
constexpr double kSeenAgain = 2;
constexpr double kHintSigmas = 3;  // so far from what was said a place is looked for

}  // namespace

MapSearch::MapSearch(SavedMap map, const SlamConfig& config, bool is_own)
    : map_(std::move(map)), is_own_(is_own), look_(config), landmarks_(LandmarkMapConfig{}) {
  gatherLandmarks();
}

void MapSearch::gatherLandmarks() {
  landmarks_ = LandmarkMap(LandmarkMapConfig{});
  for (Landmark landmark : map_.landmarks) {
    if (near_ && !near_->mayShow(landmark)) continue;
    landmark.track_id = kNoTrack;
    landmarks_.add(landmark);
  }
}

void MapSearch::lookNear(const PlaceHint& hint) {
  near_ = Near{hint, std::nullopt};
  sights_.clear();
  gatherLandmarks();
}

bool MapSearch::Near::mayShow(const Landmark& landmark) const {
  const double off_m = (landmark.position_map.head<2>() - hint.position_map_m).norm();
  return off_m < kHintSigmas * hint.position_sigma_m + kSeenAgain * landmark.seen_distance_m;
}

bool MapSearch::Near::allows(const MapEntry& entry) const {
  const Eigen::Isometry3d T_loaded_base = entry.T_loaded_flight * *T_flight_base;
  const Eigen::Vector2d off_m = T_loaded_base.translation().head<2>() - hint.position_map_m;
  const double turn_rad =
      headingOf(T_loaded_base.linear() * rotationAboutZ(hint.heading_rad).transpose());
  return off_m.norm() < kHintSigmas * hint.position_sigma_m &&
         std::abs(turn_rad) < kHintSigmas * hint.heading_sigma_rad;
}

std::optional<MapEntry> MapSearch::see(const ImageFeatures& features,
                                       const Eigen::Isometry3d& T_flight_cam,
                                       const Eigen::Isometry3d& T_base_cam, FrameBudget& budget) {
  if (near_ && !near_->T_flight_base) near_->T_flight_base = T_flight_cam * T_base_cam.inverse();
  if (looked_ns_ != 0 && seconds(features.stamp_ns - looked_ns_) < kBetweenLooks_s)
    return std::nullopt;
  if (!budget.take(OptionalWork::kPlaceSearch)) return std::nullopt;
  looked_ns_ = features.stamp_ns;
  std::optional<PlaceSight> sight = look_.at(features, T_flight_cam, landmarks_);
  budget.done(OptionalWork::kPlaceSearch);
  if (sight && near_ && !near_->allows(sight->entry)) sight.reset();
  if (!sights_.add(sight, is_own_ || near_)) return std::nullopt;
  sight->entry.anchor = sight->anchor_id - 1;
  return sight->entry;
}

}  // namespace ardrone_vslam
