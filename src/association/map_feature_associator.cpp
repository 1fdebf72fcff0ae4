// SPDX-License-Identifier: BSD-3-Clause
#include "association/map_feature_associator.hpp"

#include <cmath>

#include "linear/portable_math.hpp"
#include "map/triangulation.hpp"

namespace ardrone_vslam {

MapFeatureAssociator::MapFeatureAssociator(const AssociationConfig& config)
    : config_(config), search_(config.matcher) {
  validate(config);
}

void MapFeatureAssociator::match(const FrameView& view, const FeatureMap& map,
                                 const std::vector<bool>& taken, AssociationResult& result) {
  result.clear();
  search_.begin(view, map.size());
  searched_.clear();
  for (std::size_t f = 0; f < view.size(); ++f) {
    if (taken[f]) search_.take(static_cast<int>(f));
  }
  for (std::size_t f = 0; f < view.size(); ++f) {
    const auto feature = static_cast<int>(f);
    if (search_.isTaken(feature)) continue;
    const int target = map.indexOfTrack(view.features().track_id[f]);
    if (target >= 0) decide(view, map, {target, feature}, result);
  }
  search(view, map, result);
  for (const int target : searched_) {
    const int feature = search_.bestFeature(target);
    if (feature != TargetSearch::kNobody) decide(view, map, {target, feature}, result);
  }
}

void MapFeatureAssociator::decide(const FrameView& view, const FeatureMap& map,
                                  const Association& candidate, AssociationResult& result) {
  ++result.candidates;
  search_.take(candidate.feature);
  const MapFeature& first = map.all()[static_cast<std::size_t>(candidate.target)];
  if (isEpipolarMismatch(view, first, candidate.feature)) {
    ++result.mismatches;
  } else {
    result.matches.push_back(candidate);
  }
}

/// Entries whose track has ended are looked for by descriptor. A near point moves away from where
/// rotation alone puts it, hence the window.
void MapFeatureAssociator::search(const FrameView& view, const FeatureMap& map,
                                  AssociationResult& result) {
  search_.openWindows(view);
  const auto radius_px = static_cast<float>(config_.search_radius_px);
  for (std::size_t i = 0; i < map.size(); ++i) {
    const MapFeature& entry = map.all()[i];
    if (map.isRemoved(i) || search_.featureOfTrack(entry.track_id) != TargetSearch::kNobody)
      continue;
    Eigen::Vector2f centre_px;
    if (!view.idealPixel(entry.ray.direction_map, entry.elevation, centre_px)) continue;
    ++result.in_view;
    searched_.push_back(static_cast<int>(i));
    search_.search(static_cast<int>(i), entry.descriptor, centre_px, radius_px);
  }
}

bool MapFeatureAssociator::isEpipolarMismatch(const FrameView& view, const MapFeature& first,
                                              int feature) const {
  const Ray present = view.ray(static_cast<std::size_t>(feature));
  const auto offset = epipolarOffset(first.ray, present);
  if (!offset) return false;  // no baseline yet: nothing to test, and nothing to triangulate either
  // An uncertain baseline turns the epipolar plane about the first ray, and the parallax with it.
  const double baseline_m = (present.origin_map - first.ray.origin_map).norm();
  const double rotation_rad =
      config_.threshold_sigmas * view.sigmaSince_m(first.position_variance_m2) / baseline_m;
  const double pixels_rad = config_.epipolar_threshold_px / view.focalLength_px();
  const double threshold =
      pixels_rad + rotation_rad * portable::hypot(offset->along, offset->across);
  return offset->across > threshold || offset->along < -threshold ||
         offset->ahead < -(pixels_rad + rotation_rad);
}

}  // namespace ardrone_vslam
