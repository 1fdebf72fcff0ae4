// SPDX-License-Identifier: BSD-3-Clause
#include "map/mapper.hpp"

#include <cmath>

#include "linear/portable_math.hpp"

namespace ardrone_vslam {
namespace {

/// The feature that saw a landmark last stands for it: its descriptor, track and direction.
void rememberObservation(const FrameView& view, std::size_t feature, Landmark& landmark) {
  landmark.track_id = view.features().track_id[feature];
  landmark.descriptor = view.features().descriptor[feature];
  landmark.view_direction_map = view.ray(feature).direction_map.cast<float>();
  landmark.seen_distance_m = static_cast<float>((landmark.position_map - view.origin_map()).norm());
  landmark.height_m = static_cast<float>(view.elevation(feature)) * landmark.seen_distance_m;
  landmark.last_seen_ns = view.features().stamp_ns;
  landmark.times_missed = 0;
  constexpr int kMost = 1'000'000'000;  // a year in view at 30 Hz: more would tell nothing new
  if (landmark.times_seen < kMost) ++landmark.times_seen;
}

}  // namespace

double Mapper::sigmaOf_m(const FrameView& view, double variance_then_m2, double depth_m) const {
  const double sigma_p =
      portable::hypot(config_.position_sigma_m, view.sigmaSince_m(variance_then_m2));
  return measurementSigma_m(sigma_p, depth_m, angleSigma_rad(view.focalLength_px()));
}

void Mapper::refine(const FrameView& view, const std::vector<Association>& matches,
                    LandmarkMap& map) const {
  for (const Association& match : matches) {
    const auto feature = static_cast<std::size_t>(match.feature);
    Landmark& landmark = map.at(static_cast<std::size_t>(match.target));
    const Ray ray = view.ray(feature);
    const Ray* first_ray = map.firstRay(landmark.id);
    if (first_ray != nullptr) widenBaseline(view, feature, *first_ray, landmark);
    const double depth = (landmark.position_map - ray.origin_map).dot(ray.direction_map);  // (5.20)
    const Eigen::Vector3d measured = ray.origin_map + depth * ray.direction_map;           // (5.21)
    const double sigma = sigmaOf_m(view, landmark.position_variance_m2, std::abs(depth));  // (5.22)
    const double variance = double{landmark.sigma_m} * landmark.sigma_m;
    const double gain = variance / (variance + sigma * sigma);                // (5.30-5.32)
    landmark.position_map += gain * (measured - landmark.position_map);       // (5.33)
    landmark.sigma_m = static_cast<float>(std::sqrt((1 - gain) * variance));  // (5.34)
    rememberObservation(view, feature, landmark);
  }
}

void Mapper::widenBaseline(const FrameView& view, std::size_t feature, const Ray& first_ray,
                           Landmark& landmark) const {
  // A track that goes on is hardly ever a mismatch, a landmark found by its descriptor may be one.
  if (landmark.track_id != view.features().track_id[feature]) return;
  // A wrong feature may still lie within the landmark's threshold, and would count for good, as the
  // parallax only grows. Of the first view's epipolar plane it seldom lies within three sigmas.
  const auto offset = epipolarOffset(first_ray, view.ray(feature));
  if (!offset || offset->across > 3 * angleSigma_rad(view.focalLength_px())) return;
  const auto point = triangulate(first_ray, view.ray(feature));
  if (!point || point->parallax_rad < config_.baseline_growth * landmark.parallax_rad) return;
  // After a long way round the drift between the two views would turn the map: then the wider
  // baseline gives no better depth.
  const double sigma = sigmaOf_m(view, landmark.position_variance_m2, point->depth_m);
  const double depth_sigma_m = depthSigma_m(sigma, point->parallax_rad);
  if (depth_sigma_m > landmark.depth_sigma_m) return;
  landmark.position_map = point->position_map;
  landmark.parallax_rad = static_cast<float>(point->parallax_rad);
  landmark.depth_sigma_m = static_cast<float>(depth_sigma_m);
}

void Mapper::remember(const FrameView& view, const std::vector<Association>& matches,
                      LandmarkMap& map) {
  for (const Association& match : matches)
    rememberObservation(view, static_cast<std::size_t>(match.feature),
                        map.at(static_cast<std::size_t>(match.target)));
}

int Mapper::countMissed(const std::vector<int>& missed, LandmarkMap& map) const {
  std::vector<std::uint32_t> dropped;
  for (const int index : missed) {
    const int times_missed = map.addMiss(static_cast<std::size_t>(index));
    const Landmark& landmark = map.all()[static_cast<std::size_t>(index)];
    if (landmark.times_seen <= 2 && times_missed >= config_.drop_unconfirmed_after)
      dropped.push_back(landmark.id);
  }
  for (const std::uint32_t id : dropped) map.remove(id);
  return static_cast<int>(dropped.size());
}

int Mapper::countFailed(const std::vector<int>& failed, LandmarkMap& map) const {
  constexpr int kPresumed = 2;  // times seen: one was not seen often enough to be judged
  std::vector<std::uint32_t> dropped;
  for (const int index : failed) {
    const int times_failed = map.addFailure(static_cast<std::size_t>(index));
    const Landmark& landmark = map.all()[static_cast<std::size_t>(index)];
    if (times_failed > config_.drop_failing_ratio * (kPresumed + landmark.times_seen))
      dropped.push_back(landmark.id);
  }
  for (const std::uint32_t id : dropped) map.remove(id);
  return static_cast<int>(dropped.size());
}

int Mapper::triangulateMatches(const FrameView& view, const std::vector<Association>& matches,
                               FeatureMap& features, LandmarkMap& landmarks,
                               std::vector<bool>& used) const {
  const double min_parallax_rad = config_.min_parallax_deg * M_PI / 180;
  int made = 0;
  for (const Association& match : matches) {
    const auto feature = static_cast<std::size_t>(match.feature);
    const auto entry = static_cast<std::size_t>(match.target);
    const MapFeature& first = features.all()[entry];
    const bool same_track =
        first.track_id != kNoTrack && first.track_id == view.features().track_id[feature];
    const auto point = triangulate(first.ray, view.ray(feature));
    if (!point || point->parallax_rad < min_parallax_rad) {
      if (same_track)
        used[feature] = true;  // the older view has the longer baseline: it stays and waits
      continue;
    }
    features.remove(entry);
    if (point->depth_m > config_.max_depth_m) continue;
    used[feature] = true;
    Landmark landmark;
    landmark.position_map = point->position_map;
    const double sigma = sigmaOf_m(view, first.position_variance_m2, point->depth_m);  // (5.19)
    landmark.position_variance_m2 = static_cast<float>(view.positionVariance_m2());
    landmark.sigma_m = static_cast<float>(sigma);
    landmark.depth_sigma_m = static_cast<float>(depthSigma_m(sigma, point->parallax_rad));
    landmark.parallax_rad = static_cast<float>(point->parallax_rad);
    landmark.first_seen_ns = first.stamp_ns;
    landmark.times_seen = 1;
    rememberObservation(view, feature, landmark);
    landmarks.setFirstRay(landmarks.add(landmark), first.ray);
    ++made;
  }
  return made;
}

void Mapper::storeRest(const FrameView& view, const std::vector<bool>& used,
                       FeatureMap& features) const {
  for (std::size_t i = 0; i < view.size(); ++i) {
    if (used[i]) continue;
    MapFeature entry;
    entry.track_id = view.features().track_id[i];
    entry.ray = view.ray(i);
    entry.elevation = view.elevation(i);
    entry.position_variance_m2 = view.positionVariance_m2();
    entry.stamp_ns = view.features().stamp_ns;
    entry.descriptor = view.features().descriptor[i];
    features.add(entry);
  }
}

}  // namespace ardrone_vslam
