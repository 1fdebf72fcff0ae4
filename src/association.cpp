// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/association.hpp"

#include <algorithm>
#include <cmath>

namespace ardrone_vslam {
namespace {

constexpr int kNobody = -1;
constexpr double kSmallestDistance_m = 1e-3;

double radians(double degrees) {
  return degrees * M_PI / 180.0;
}

}  // namespace

Associator::Associator(const AssociationConfig& config) : config_(config) {
  validate(config);
}

void Associator::begin(const FrameView& view, std::size_t target_count) {
  best_of_target_.assign(target_count, BestTwo{});
  best_of_feature_.assign(view.size(), BestTwo{});
  feature_taken_.assign(view.size(), false);
  targets_in_view_.clear();
  feature_of_track_.clear();
  for (std::size_t i = 0; i < view.size(); ++i) {
    const std::uint32_t track_id = view.features().track_id[i];
    if (track_id != kNoTrack) feature_of_track_[track_id] = static_cast<int>(i);
  }
}

int Associator::featureOfTrack(std::uint32_t track_id) const {
  const auto entry = feature_of_track_.find(track_id);
  return entry == feature_of_track_.end() ? kNobody : entry->second;
}

void Associator::search(const FrameView& view, const Descriptor& descriptor, const Window& window,
                        int target) {
  view.visit(window.centre_px, window.radius_px, [&](int feature) {
    const auto f = static_cast<std::size_t>(feature);
    if (feature_taken_[f]) return;
    const int distance = hammingDistance(descriptor, view.features().descriptor[f]);
    best_of_target_[static_cast<std::size_t>(target)].offer(feature, distance);
    best_of_feature_[f].offer(target, distance);
  });
}

int Associator::bestFeature(int target) const {
  const BestTwo& best = best_of_target_[static_cast<std::size_t>(target)];
  if (!accept(best, config_.matcher)) return kNobody;
  const auto feature = static_cast<std::size_t>(best.index);
  if (feature_taken_[feature]) return kNobody;  // by a target before, if there is no cross check
  if (config_.matcher.cross_check && best_of_feature_[feature].index != target) return kNobody;
  return best.index;
}

double Associator::margin_px(const FrameView& view, const Landmark& landmark) const {
  const double distance_m = (landmark.position_map - view.origin_map()).norm();
  return config_.threshold_deviations * view.focalLength_px() *
         view.deviationSince_m(landmark.position_variance_m2) / distance_m;
}

bool Associator::landmarkWindow(const FrameView& view, const Landmark& landmark,
                                Window& window) const {
  const Eigen::Vector3d offset = landmark.position_map - view.origin_map();
  const double distance = offset.norm();
  const double smallest_cosine = std::cos(radians(config_.max_view_angle_deg));
  if (distance < kSmallestDistance_m ||
      landmark.view_direction_map.dot(offset) < smallest_cosine * distance)
    return false;
  if (!view.idealPixel(offset, landmark.height_m / distance, window.centre_px)) return false;
  window.radius_px = static_cast<float>(config_.search_radius_px + margin_px(view, landmark));
  return true;
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
  feature_taken_[static_cast<std::size_t>(candidate.feature)] = true;
  return true;
}

void Associator::matchLandmarks(const FrameView& view, const LandmarkMap& map,
                                AssociationResult& result) {
  result = {};
  begin(view, map.size());
  // Tracks first: they need no search, and their features are not offered to other landmarks.
  window_of_target_.clear();
  for (std::size_t i = 0; i < map.size(); ++i) {
    const Landmark& landmark = map.all()[i];
    Window window;
    if (!landmarkWindow(view, landmark, window)) continue;
    ++result.in_view;
    const int target = static_cast<int>(i);
    const int feature = featureOfTrack(landmark.track_id);
    const bool free = feature != kNobody && !feature_taken_[static_cast<std::size_t>(feature)];
    if (free && decideLandmark(view, map, {target, feature}, result)) continue;
    targets_in_view_.push_back(target);
    window_of_target_.push_back(window);
  }
  for (std::size_t k = 0; k < targets_in_view_.size(); ++k) {
    const int target = targets_in_view_[k];
    search(view, map.all()[static_cast<std::size_t>(target)].descriptor, window_of_target_[k],
           target);
  }
  for (const int target : targets_in_view_) {
    const int feature = bestFeature(target);
    if (feature == kNobody || !decideLandmark(view, map, {target, feature}, result))
      result.missed.push_back(target);
  }
}

bool Associator::isLandmarkMismatch(const FrameView& view, const Landmark& landmark,
                                    int feature) const {
  const Ray ray = view.ray(static_cast<std::size_t>(feature));
  const Eigen::Vector3d predicted = (landmark.position_map - ray.origin_map).normalized();
  const double angle =
      (config_.landmark_threshold_px + margin_px(view, landmark)) / view.focalLength_px();
  return !(predicted.dot(ray.direction_map) > std::cos(std::min(angle, M_PI)));  // (5.36)
}

void Associator::matchMapFeatures(const FrameView& view, const FeatureMap& map,
                                  const std::vector<bool>& taken, AssociationResult& result) {
  result = {};
  begin(view, map.size());
  std::copy(taken.begin(), taken.end(), feature_taken_.begin());
  const auto decide = [&](int target, int feature) {
    ++result.candidates;
    feature_taken_[static_cast<std::size_t>(feature)] = true;
    const MapFeature& first = map.all()[static_cast<std::size_t>(target)];
    if (isEpipolarMismatch(view, first, feature)) {
      ++result.mismatches;
      return;
    }
    result.matches.push_back({target, feature});
  };

  for (std::size_t f = 0; f < view.size(); ++f) {
    if (feature_taken_[f]) continue;
    const int target = map.indexOfTrack(view.features().track_id[f]);
    if (target != kNobody) decide(target, static_cast<int>(f));
  }
  // Entries whose track has ended are looked for by descriptor. A near point moves away from where
  // rotation alone puts it, hence the window.
  for (std::size_t i = 0; i < map.size(); ++i) {
    const MapFeature& entry = map.all()[i];
    if (map.isRemoved(i) || featureOfTrack(entry.track_id) != kNobody) continue;
    Window window;
    if (!view.idealPixel(entry.ray.direction_map, entry.elevation, window.centre_px)) continue;
    window.radius_px = static_cast<float>(config_.search_radius_px);
    ++result.in_view;
    targets_in_view_.push_back(static_cast<int>(i));
    search(view, entry.descriptor, window, static_cast<int>(i));
  }
  for (const int target : targets_in_view_) {
    const int feature = bestFeature(target);
    if (feature != kNobody) decide(target, feature);
  }
}

bool Associator::isEpipolarMismatch(const FrameView& view, const MapFeature& first,
                                    int feature) const {
  const Ray present = view.ray(static_cast<std::size_t>(feature));
  const auto offset = epipolarOffset(first.ray, present);
  if (!offset) return false;  // no baseline yet: nothing to test, and nothing to triangulate either
  // An uncertain baseline turns the epipolar plane about the first ray, and the parallax with it.
  const double baseline_m = (present.origin_map - first.ray.origin_map).norm();
  const double turn_rad =
      config_.threshold_deviations * view.deviationSince_m(first.position_variance_m2) / baseline_m;
  const double pixels_rad = config_.epipolar_threshold_px / view.focalLength_px();
  const double threshold = pixels_rad + turn_rad * std::hypot(offset->along, offset->across);
  return offset->across > threshold || offset->along < -threshold ||
         offset->ahead < -(pixels_rad + turn_rad);
}

}  // namespace ardrone_vslam
