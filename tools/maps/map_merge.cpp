// SPDX-License-Identifier: BSD-3-Clause
#include "maps/map_merge.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

#include "maps/joint_maps.hpp"
#include "maps/map_parts.hpp"

namespace ardrone_vslam {
namespace {

/// All landmarks of both, of each pair that which was seen more often.
SavedMap together(const JointMaps& joint, const std::vector<LandmarkPair>& pairs) {
  SavedMap map = joint.a();
  const SavedMap& b = joint.b();
  const auto first_of_b = static_cast<std::uint32_t>(map.anchors.size());
  map.stamp_ns = std::max(map.stamp_ns, b.stamp_ns);
  for (const MapCamera& camera : b.cameras) addCamera(camera, map.cameras);
  map.anchors.insert(map.anchors.end(), b.anchors.begin(), b.anchors.end());
  map.anchor_covariance = joint.anchorCovariance();
  std::vector<Landmark> of_b = b.landmarks;
  for (Landmark& landmark : of_b) landmark.anchor_id += first_of_b;
  std::vector<bool> is_gone(of_b.size(), false);
  for (const LandmarkPair& pair : pairs) {
    Landmark& kept = map.landmarks[pair.of_a];
    const Landmark& other = of_b[pair.of_b];
    is_gone[pair.of_b] = true;
    const auto times_seen = static_cast<std::int64_t>(kept.times_seen) + other.times_seen;
    if (other.times_seen > kept.times_seen) kept = other;
    kept.times_seen = static_cast<int>(std::min<std::int64_t>(times_seen, 1'000'000'000));
  }
  for (std::size_t i = 0; i < of_b.size(); ++i) {
    if (!is_gone[i]) map.landmarks.push_back(of_b[i]);
  }
  std::vector<std::size_t> oldest_first(map.anchors.size());
  std::iota(oldest_first.begin(), oldest_first.end(), 0);
  std::stable_sort(oldest_first.begin(), oldest_first.end(), [&map](std::size_t i, std::size_t j) {
    return map.anchors[i].stamp_ns < map.anchors[j].stamp_ns;
  });
  map.flight = {};
  keepAnchors(map, oldest_first);
  for (std::size_t i = 0; i < map.landmarks.size(); ++i)
    map.landmarks[i].id = static_cast<std::uint32_t>(i + 1);
  return map;
}

}  // namespace

std::string mergeFault(const SavedMap& a, const SavedMap& b) {
  const auto is_of_a = [&a](const MapCamera& camera) {
    return cameraDifference(a.cameras, camera).empty();
  };
  if (std::none_of(b.cameras.begin(), b.cameras.end(), is_of_a))
    return "they are of two cameras (map_tool info): landmarks look otherwise to another one";
  if (a.anchors.size() + b.anchors.size() > kMostMergedAnchors)
    return "they have more than " + std::to_string(kMostMergedAnchors) +
           " anchors together; crop or prune them first";
  return "";
}

MergedMap merge(const SavedMap& a, const SavedMap& b, const MapAlignment& alignment) {
  const std::string fault = mergeFault(a, b);
  if (!fault.empty()) throw MapFileError(fault);
  JointMaps joint(a, b, alignment);
  joint.correctBy(alignment.agreed);
  MergedMap merged;
  std::vector<LandmarkPair> shared;
  std::vector<double> apart_m;
  for (const LandmarkPair& pair : alignment.agreed) {
    apart_m.push_back(joint.apart_m(pair));
    if (joint.areOne(pair)) shared.push_back(pair);
  }
  const auto middle = apart_m.begin() + static_cast<std::ptrdiff_t>(apart_m.size() / 2);
  std::nth_element(apart_m.begin(), middle, apart_m.end());
  merged.map = together(joint, shared);
  merged.shared = shared.size();
  merged.apart_m = *middle;
  const Eigen::Vector4d variances = joint.moveVariances();
  merged.sigma_m = std::sqrt(variances.head<3>().sum() / 3);
  merged.sigma_rad = std::sqrt(variances(3));
  return merged;
}

}  // namespace ardrone_vslam
