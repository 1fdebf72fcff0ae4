// SPDX-License-Identifier: BSD-3-Clause
#include "odometry/image_rays.hpp"

#include <cmath>

namespace ardrone_vslam {
namespace {

/// Whether alignment tells the place in every direction: a corner on an edge slides along it, and
/// where alignment fails most matches are wrong. Of a tracker that does not align: every one.
bool isSharp(const ImageFeatures& features, std::size_t i) {
  if (features.information.empty()) return true;
  constexpr float kLeast_per_px2 = 1 / (0.5F * 0.5F);
  const PixelInformation& told = features.information[i];
  const float half = (told.xx_per_px2 - told.yy_per_px2) / 2;
  const float spread = std::sqrt(half * half + told.xy_per_px2 * told.xy_per_px2);
  return (told.xx_per_px2 + told.yy_per_px2) / 2 - spread > kLeast_per_px2;
}

}  // namespace

void ImageRays::take(const ImageFeatures& features, TrackOrder& order) {
  stamp_ns = features.stamp_ns;
  focal_length_px = features.focal_length_px;
  rays.clear();
  order.reset(features);
  for (const TrackedFeature& one : order)
    if (isSharp(features, one.feature))
      rays.push_back({one.track_id, features.bearing_cam[one.feature]});
}

void findPairs(const ImageRays& then, const ImageRays& now, std::vector<BearingPair>& pairs) {
  pairs.clear();
  auto ray = then.rays.begin();
  for (const ImageRays::Ray& one : now.rays) {
    while (ray != then.rays.end() && ray->track_id < one.track_id) ++ray;
    if (ray == then.rays.end()) break;
    if (ray->track_id != one.track_id) continue;
    pairs.push_back({ray->bearing_cam.cast<double>(), one.bearing_cam.cast<double>()});
  }
  if (pairs.size() <= kMostPairs) return;
  for (std::size_t i = 0; i < kMostPairs; ++i) pairs[i] = pairs[i * pairs.size() / kMostPairs];
  pairs.resize(kMostPairs);
}

}  // namespace ardrone_vslam
