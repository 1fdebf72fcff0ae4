// SPDX-License-Identifier: BSD-3-Clause
#include "map_search/place_look.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <map>

#include "ardrone_vslam/rotation.hpp"
#include "linear/median.hpp"
#include "linear/scalars.hpp"
#include "map_update/observation_rays.hpp"
#include "map_update/relocation.hpp"
#include "window/rays.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kMapBends = 0.01;  // landmarks beside each other, of their distance
// The landmarks that gave the observation correct the pose at once: what is entered with must not
// say the same again, so it is taken for three times worse than it is.
constexpr double kPriorVariance = 9;

const Eigen::Vector3d kCamera = Eigen::Vector3d::Zero();  // in the rig, which here is the camera

/// Position and heading by the landmarks that agree; roll and pitch are the prediction's.
Eigen::Matrix4d covarianceOf(const ObservationConsensus& consensus, double sigma_a) {
  Clone pose;
  pose.position_map = consensus.position_map;
  pose.R_map_rig = consensus.R_map_rig;
  Eigen::Matrix4d information = Eigen::Matrix4d::Zero();
  for (const MapObservation& s : consensus.observations) {
    const auto ray = rayResidual(pose, kCamera, s.bearing_rig, s.point_map);
    if (!ray) continue;
    Eigen::Matrix<double, 2, 4> H;
    H << ray->pose.leftCols<3>(), ray->pose.col(5);
    const Eigen::Matrix2d noise =
        (squared(sigma_a) + squared(kSlack_rad)) * Eigen::Matrix2d::Identity() +
        ray->point * s.covariance_m2 * ray->point.transpose();
    information += H.transpose() * noise.inverse() * H;
  }
  return information.inverse();
}

/// What most of them belong to, and when those were seen last, the median.
void noteOrigin(const std::vector<MapObservation>& observations, const LandmarkMap& map,
                PlaceSight& sight) {
  std::map<std::uint32_t, std::vector<std::int64_t>> seen_ns_of_anchor;
  for (const MapObservation& s : observations) {
    const Landmark& landmark = map.all()[s.index];
    seen_ns_of_anchor[landmark.anchor_id].push_back(landmark.last_seen_ns);
  }
  const auto fewer = [](const auto& a, const auto& b) { return a.second.size() < b.second.size(); };
  auto& [anchor_id, seen_ns] =
      *std::max_element(seen_ns_of_anchor.begin(), seen_ns_of_anchor.end(), fewer);
  const auto middle = seen_ns.begin() + static_cast<std::ptrdiff_t>(seen_ns.size() / 2);
  std::nth_element(seen_ns.begin(), middle, seen_ns.end());
  sight.anchor_id = anchor_id;
  sight.last_seen_ns = *middle;
}

}  // namespace

PlaceLook::PlaceLook(const SlamConfig& config)
    : angle_sigma_px_(config.msckf.track_sigma_px),
      tilt_sigma_rad_(radians(config.msckf.odometry.tilt_sigma_deg)),
      index_from_landmarks_(static_cast<std::size_t>(config.association.index_from_landmarks)),
      matcher_(config.association.matcher, config.association.index_probes),
      cover_(config.association) {}

std::vector<MapObservation> PlaceLook::observe(const ImageFeatures& features, LandmarkMap& map,
                                               const LookLimits& limits) {
  std::vector<MapObservation> observations;
  if (features.size() == 0) return observations;
  MatchMethod method = MatchMethod::kExact;
  if (map.size() >= index_from_landmarks_) {
    // Of a large map it takes several images to lay the index out.
    if (!map.advanceIndex()) return observations;
    method = MatchMethod::kIndexed;
  }
  // They are in raster order.
  const std::size_t step = 1 + (features.size() - 1) / limits.most_features;
  std::vector<bool> left_out(features.size());
  for (std::size_t f = 0; f < left_out.size(); ++f) left_out[f] = f % step != 0;
  for (const DescriptorMatch& match :
       matcher_.match(features, left_out, map, method, limits.unseen_since_ns)) {
    MapObservation seen;
    seen.index = static_cast<std::size_t>(match.train);
    seen.bearing_rig = features.bearing_cam[static_cast<std::size_t>(match.query)].cast<double>();
    seen.point_map = map.all()[seen.index].position_map;
    seen.covariance_m2 = map.all()[seen.index].covariance_m2.full();
    observations.push_back(seen);
  }
  return observations;
}

std::optional<PlaceSight> PlaceLook::at(const ImageFeatures& features,
                                        const Eigen::Isometry3d& T_flight_cam, LandmarkMap& map,
                                        const LookLimits& limits) {
  Clone gravity;
  gravity.R_map_rig = T_flight_cam.linear();
  const double sigma_a = angle_sigma_px_ / features.focal_length_px;
  const auto consensus =
      relocateAnywhere(gravity, kCamera, observe(features, map, limits), sigma_a, tilt_sigma_rad_);
  if (!consensus || static_cast<int>(consensus->observations.size()) < kFewestFixLandmarks)
    return std::nullopt;

  PlaceSight sight;
  sight.camera_flight = T_flight_cam.translation();
  MapEntry& entry = sight.entry;
  entry.camera_loaded = consensus->position_map;
  const double heading_rad = headingOf(consensus->R_map_rig * T_flight_cam.linear().transpose());
  entry.T_loaded_flight.linear() = rotationAboutZ(heading_rad);
  entry.T_loaded_flight.translation() =
      entry.camera_loaded - entry.T_loaded_flight.linear() * sight.camera_flight;
  entry.covariance = kPriorVariance * covarianceOf(*consensus, sigma_a);
  if (!entry.covariance.allFinite()) return std::nullopt;
  noteOrigin(consensus->observations, map, sight);
  std::vector<double> distances_m;
  for (const MapObservation& s : consensus->observations)
    distances_m.push_back((s.point_map - entry.camera_loaded).norm());
  sight.distance_m = medianOf(distances_m);
  sight.cover = cover(features, *consensus, sight.distance_m, map);
  return sight;
}

double PlaceLook::cover(const ImageFeatures& features, const ObservationConsensus& consensus,
                        double distance_m, LandmarkMap& map) {
  Eigen::Isometry3d T_loaded_cam = Eigen::Isometry3d::Identity();
  T_loaded_cam.linear() = consensus.R_map_rig;
  T_loaded_cam.translation() = consensus.position_map;
  FrameView view;
  view.reset(features, T_loaded_cam, false);
  view.setPositionVariance(squared(kMapBends * distance_m), false);
  return cover_.of(view, map);
}

}  // namespace ardrone_vslam
