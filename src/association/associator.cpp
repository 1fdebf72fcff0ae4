// SPDX-License-Identifier: BSD-3-Clause
#include "association/associator.hpp"

#include <algorithm>
#include <cmath>

#include "linear/median.hpp"
#include "linear/portable_math.hpp"

namespace ardrone_vslam {
namespace {

/// So many landmarks tell how far away the map is.
constexpr std::size_t kDistanceSample = 1000;
/// So many searches ahead a landmark's descriptor is asked for.
constexpr std::size_t kPrefetched = 8;

/// What the pose's uncertainty adds to a window.
double margin_px(const AssociationConfig& config, const FrameView& view, std::uint32_t anchor_id,
                 double position_variance_m2, double distance_m) {
  return config.threshold_sigmas * view.focalLength_px() *
         view.driftAngle_rad(anchor_id, position_variance_m2, distance_m);
}

}  // namespace

double mismatchThreshold_rad(const AssociationConfig& config, const FrameView& view,
                             const Landmark& landmark, double distance_m) {
  const double drift_px =
      margin_px(config, view, landmark.anchor_id, landmark.position_variance_m2, distance_m);
  return std::min((config.landmark_threshold_px + drift_px) / view.focalLength_px(), M_PI);
}

Associator::Associator(const AssociationConfig& config)
    : config_(config),
      global_matcher_(config.matcher, config.index_probes),
      search_(config.matcher) {
  validate(config);
}

bool Associator::decideLandmark(const FrameView& view, const LandmarkMap& map,
                                const Association& candidate, AssociationResult& result) {
  ++result.candidates;
  if (isLandmarkMismatch(view, map.all()[static_cast<std::size_t>(candidate.target)],
                         candidate.feature)) {
    ++result.mismatches;
    return false;
  }
  result.matches.push_back(candidate);
  search_.take(candidate.feature);
  return true;
}

void Associator::matchLandmarks(const FrameView& view, LandmarkMap& map,
                                AssociationResult& result) {
  result.clear();
  const LandmarkColumns& columns = map.columns(view.origin_map());
  columns.project(view, {config_.max_view_angle_deg, config_.max_distance_ratio}, visible_);
  result.in_view = static_cast<int>(visible_.count);
  search_.begin(view, visible_.count);
  result.method = chooseMethod(view, map, columns);
  if (result.method == MatchMethod::kGuided) {
    matchGuided(view, map, columns, result);
  } else {
    matchGlobally(view, map, columns, result);
  }
}

bool Associator::windowsAreWide(const FrameView& view, const LandmarkColumns& columns) {
  const auto radiusOf = [&](std::size_t landmark, float distance_m) {
    const double margin = margin_px(config_, view, columns.anchorId(landmark),
                                    columns.positionVariance_m2(landmark), distance_m);
    return static_cast<float>(config_.search_radius_px + margin);
  };
  radius_px_.resize(visible_.count);
  for (std::size_t k = 0; k < visible_.count; ++k)
    radius_px_[k] = radiusOf(static_cast<std::size_t>(visible_.index[k]), visible_.distance_m[k]);
  sorted_radii_px_ = radius_px_;
  if (sorted_radii_px_.empty()) {
    // Nothing is where the camera is thought to be: wide or not is a matter of the whole map.
    const std::size_t step = 1 + columns.size() / kDistanceSample;
    for (std::size_t i = 0; i < columns.size(); i += step) {
      const float distance_m = columns.seenDistance_m(i);
      if (distance_m > 0) sorted_radii_px_.push_back(radiusOf(i, distance_m));
    }
  }
  if (sorted_radii_px_.empty()) return false;
  return medianOf(sorted_radii_px_) > config_.max_window_share * view.features().width_px;
}

MatchMethod Associator::chooseMethod(const FrameView& view, LandmarkMap& map,
                                     const LandmarkColumns& columns) {
  if (!windowsAreWide(view, columns)) return MatchMethod::kGuided;
  if (map.size() < static_cast<std::size_t>(config_.index_from_landmarks))
    return MatchMethod::kExact;
  // The index is built over several frames, so that none of them waits for all of it.
  return map.advanceIndex() ? MatchMethod::kIndexed : MatchMethod::kExact;
}

void Associator::matchGuided(const FrameView& view, const LandmarkMap& map,
                             const LandmarkColumns& columns, AssociationResult& result) {
  targets_in_view_.clear();
  // Tracks first: they need no search, and their features are not offered to other landmarks.
  for (std::size_t k = 0; k < visible_.count; ++k) {
    const int landmark = visible_.index[k];
    const int feature = search_.featureOfTrack(columns.trackId(static_cast<std::size_t>(landmark)));
    const bool free = feature != TargetSearch::kNobody && !search_.isTaken(feature);
    if (free && decideLandmark(view, map, {landmark, feature}, result)) continue;
    targets_in_view_.push_back(static_cast<int>(k));
  }
  search_.openWindows(view);
  const auto descriptorOf = [&](int target) -> const DescriptorBits& {
    const int landmark = visible_.index[static_cast<std::size_t>(target)];
    return map.all()[static_cast<std::size_t>(landmark)].descriptor;
  };
  for (std::size_t t = 0; t < targets_in_view_.size(); ++t) {
    // Of a large map's descriptors hardly any is in a cache.
    if (t + kPrefetched < targets_in_view_.size())
      __builtin_prefetch(&descriptorOf(targets_in_view_[t + kPrefetched]));
    const int target = targets_in_view_[t];
    const auto k = static_cast<std::size_t>(target);
    search_.search(target, descriptorOf(target), visible_.pixel_px(k), radius_px_[k]);
  }
  for (const int target : targets_in_view_) {
    const int landmark = visible_.index[static_cast<std::size_t>(target)];
    const int feature = search_.bestFeature(target);
    if (feature == TargetSearch::kNobody || !decideLandmark(view, map, {landmark, feature}, result))
      result.missed.push_back(landmark);
  }
}

void Associator::matchGlobally(const FrameView& view, LandmarkMap& map,
                               const LandmarkColumns& columns, AssociationResult& result) {
  landmark_taken_.assign(columns.size(), false);
  const auto decide = [&](const Association& candidate) {
    const auto landmark = static_cast<std::size_t>(candidate.target);
    if (landmark_taken_[landmark] || search_.isTaken(candidate.feature)) return;
    landmark_taken_[landmark] = decideLandmark(view, map, candidate, result);
  };
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const int feature = search_.featureOfTrack(columns.trackId(i));
    if (feature != TargetSearch::kNobody) decide({static_cast<int>(i), feature});
  }
  for (const DescriptorMatch& match :
       global_matcher_.match(view.features(), search_.taken(), map, result.method)) {
    decide({match.train, match.query});
  }
}

bool Associator::isLandmarkMismatch(const FrameView& view, const Landmark& landmark,
                                    int feature) const {
  const Ray ray = view.ray(static_cast<std::size_t>(feature));
  const Eigen::Vector3d offset = landmark.position_map - ray.origin_map;
  const double distance_m = offset.norm();
  const Eigen::Vector3d predicted = offset / distance_m;
  const double angle = mismatchThreshold_rad(config_, view, landmark, distance_m);
  return !(predicted.dot(ray.direction_map) > portable::cos(angle));  // (5.36)
}

}  // namespace ardrone_vslam
