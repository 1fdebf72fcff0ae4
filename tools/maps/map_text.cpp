// SPDX-License-Identifier: BSD-3-Clause
#include "maps/map_text.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <vector>

#include "maps/map_parts.hpp"
#include "trajectory/metrics.hpp"

namespace ardrone_vslam {
namespace {

using Json = nlohmann::ordered_json;

Json medianAnd90(const std::vector<double>& values) {
  return {{"median", quantile(values, 0.5)}, {"90 %", quantile(values, 0.9)}};
}

Json vectorOf(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

template <class... Values>
void append(std::string& text, const char* format, Values... values) {
  std::array<char, 400> line{};
  std::snprintf(line.data(), line.size(), format, values...);
  text += line.data();
}

}  // namespace

Json factsOf(const SavedMap& map) {
  Json facts;
  facts["landmarks"] = map.landmarks.size();
  facts["anchors"] = map.anchors.size();
  facts["made_by"] = map.made_by;
  facts["frame"] = map.frame_id;
  facts["stamp_ns"] = map.stamp_ns;
  for (const MapCamera& camera : map.cameras)
    facts["cameras"].push_back({{"width_px", camera.width_px},
                                {"height_px", camera.height_px},
                                {"focal_length_px", camera.focal_length_px}});
  std::size_t views = 0;
  for (const Keyframe& keyframe : map.flight.keyframes) views += keyframe.views.size();
  facts["keyframes"] = map.flight.keyframes.size();
  facts["views"] = views;
  if (map.landmarks.empty()) return facts;
  Eigen::Vector3d least = map.landmarks.front().position_map;
  Eigen::Vector3d most = least;
  std::vector<double> sigmas_m;
  std::vector<double> seen;
  for (const Landmark& landmark : map.landmarks) {
    least = least.cwiseMin(landmark.position_map);
    most = most.cwiseMax(landmark.position_map);
    sigmas_m.push_back(landmark.sigma_m);
    seen.push_back(landmark.times_seen);
  }
  facts["from_m"] = vectorOf(least);
  facts["to_m"] = vectorOf(most);
  facts["landmark_sigma_m"] = medianAnd90(sigmas_m);
  facts["times_seen"] = medianAnd90(seen);
  std::vector<double> anchor_sigmas_m;
  for (std::size_t i = 0; i < map.anchors.size(); ++i) {
    const auto at = coordinateOf(i);
    anchor_sigmas_m.push_back(std::sqrt(map.anchor_covariance.diagonal().segment<3>(at).sum() / 3));
  }
  facts["anchor_sigma_m"] = medianAnd90(anchor_sigmas_m);
  return facts;
}

std::string csvOf(const SavedMap& map) {
  std::string text = "id,x_m,y_m,z_m,sigma_m,times_seen,anchor,first_seen_ns,last_seen_ns\n";
  for (const Landmark& l : map.landmarks) {
    const Eigen::Vector3d& p = l.position_map;
    append(text, "%u,%.9g,%.9g,%.9g,%.6g,%d,%u,%lld,%lld\n", l.id, p.x(), p.y(), p.z(), l.sigma_m,
           l.times_seen, l.anchor_id, static_cast<long long>(l.first_seen_ns),
           static_cast<long long>(l.last_seen_ns));
  }
  return text;
}

std::string plyOf(const SavedMap& map) {
  std::string text = "ply\nformat ascii 1.0\n";
  append(text, "element vertex %zu\n", map.landmarks.size());
  text +=
      "property float x\nproperty float y\nproperty float z\nproperty float sigma_m\n"
      "property int times_seen\nend_header\n";
  for (const Landmark& l : map.landmarks) {
    const Eigen::Vector3d& p = l.position_map;
    append(text, "%.9g %.9g %.9g %.6g %d\n", p.x(), p.y(), p.z(), l.sigma_m, l.times_seen);
  }
  return text;
}

}  // namespace ardrone_vslam
