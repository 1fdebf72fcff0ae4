// SPDX-License-Identifier: BSD-3-Clause
#include "map_search/map_search.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "ardrone_vslam/rotation.hpp"
#include "linear/median.hpp"
#include "linear/portable_math.hpp"
#include "linear/scalars.hpp"
#include "map_update/observation_rays.hpp"
#include "map_update/relocation.hpp"
#include "window/rays.hpp"

namespace ardrone_vslam {
namespace {

// Images of one moment show the same, right or wrong: an observation counts only so long after
// another.
constexpr double kBetweenLooks_s = 0.2;
// A landmark is known again from so many times the distance that it was seen from.
constexpr double kSeenAgain = 2;
constexpr double kHintSigmas = 3;   // so far from what was said a place is looked for
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

}  // namespace

MapSearch::MapSearch(SavedMap map, const SlamConfig& config, bool is_own)
    : map_(std::move(map)),
      is_own_(is_own),
      angle_sigma_px_(config.msckf.track_sigma_px),
      tilt_sigma_rad_(radians(config.msckf.odometry.tilt_sigma_deg)),
      index_from_landmarks_(static_cast<std::size_t>(config.association.index_from_landmarks)),
      matcher_(config.association.matcher, config.association.index_probes),
      cover_(config.association),
      landmarks_(LandmarkMapConfig{}) {
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
                                       const Eigen::Isometry3d& T_base_cam) {
  if (near_ && !near_->T_flight_base) near_->T_flight_base = T_flight_cam * T_base_cam.inverse();
  if (looked_ns_ != 0 && seconds(features.stamp_ns - looked_ns_) < kBetweenLooks_s)
    return std::nullopt;
  looked_ns_ = features.stamp_ns;
  const std::optional<PlaceSight> sight = look(features, T_flight_cam);
  if (!sights_.add(sight, is_own_ || near_)) return std::nullopt;
  return sight->entry;
}

std::vector<MapObservation> MapSearch::observe(const ImageFeatures& features) {
  std::vector<MapObservation> observations;
  MatchMethod method = MatchMethod::kExact;
  if (landmarks_.size() >= index_from_landmarks_) {
    // Of a large map it takes several images to lay the index out.
    if (!landmarks_.advanceIndex()) return observations;
    method = MatchMethod::kIndexed;
  }
  const std::vector<bool> none_taken(features.size(), false);
  for (const DescriptorMatch& match : matcher_.match(features, none_taken, landmarks_, method)) {
    const Landmark& landmark = landmarks_.all()[static_cast<std::size_t>(match.train)];
    MapObservation seen;
    seen.bearing_rig = features.bearing_cam[static_cast<std::size_t>(match.query)].cast<double>();
    seen.point_map = landmark.position_map;
    seen.covariance_m2 = landmark.covariance_m2;
    seen.anchor = landmark.anchor_id - 1;
    observations.push_back(seen);
  }
  return observations;
}

std::optional<PlaceSight> MapSearch::look(const ImageFeatures& features,
                                          const Eigen::Isometry3d& T_flight_cam) {
  Clone gravity;
  gravity.R_map_rig = T_flight_cam.linear();
  const double sigma_a = angle_sigma_px_ / features.focal_length_px;
  const auto consensus =
      relocateAnywhere(gravity, kCamera, observe(features), sigma_a, tilt_sigma_rad_);
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
  if (!entry.covariance.allFinite() || (near_ && !near_->allows(entry))) return std::nullopt;
  std::vector<double> distances_m;
  std::vector<int> seen_of_anchor(map_.anchors.size(), 0);
  for (const MapObservation& s : consensus->observations) {
    distances_m.push_back((s.point_map - entry.camera_loaded).norm());
    ++seen_of_anchor[s.anchor];
  }
  entry.anchor = static_cast<std::size_t>(
      std::max_element(seen_of_anchor.begin(), seen_of_anchor.end()) - seen_of_anchor.begin());
  sight.distance_m = medianOf(distances_m);
  sight.cover = cover(features, *consensus, sight.distance_m);
  return sight;
}

double MapSearch::cover(const ImageFeatures& features, const ObservationConsensus& consensus,
                        double distance_m) {
  Eigen::Isometry3d T_loaded_cam = Eigen::Isometry3d::Identity();
  T_loaded_cam.linear() = consensus.R_map_rig;
  T_loaded_cam.translation() = consensus.position_map;
  FrameView view;
  view.reset(features, T_loaded_cam, false);
  view.setPositionVariance(squared(kMapBends * distance_m), false);
  return cover_.of(view, landmarks_);
}

}  // namespace ardrone_vslam
