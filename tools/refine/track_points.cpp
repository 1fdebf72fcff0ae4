// SPDX-License-Identifier: BSD-3-Clause
#include "refine/track_points.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>
#include <utility>

#include "trajectory/metrics.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kLeastParallax = 10;  // sigmas of a ray: a distance is known to a tenth
// Further off than poses of a few seconds can be: a track that jumped, a wrong landmark.
constexpr double kOffTrack_rad = 0.02;
constexpr double kOffLandmark_rad = 0.1;
constexpr std::size_t kFewPoints = 10;  // in a keyframe

Sight sightOf(const KeyframeView& view, std::size_t index, const Keyframe& keyframe) {
  const Eigen::Vector3d bearing_cam = view.bearing_cam.cast<double>();
  const Eigen::Matrix3d& R_base_cam = keyframe.T_base_cam.linear();
  const Eigen::Matrix2d information = view.information_rad2.cast<double>();
  SightRoot axes;  // columns and rows
  axes.row(0) = (Eigen::Vector3d::UnitX() - bearing_cam.x() * bearing_cam).normalized();
  axes.row(1) = bearing_cam.cross(axes.row(0).transpose());
  Sight sight;
  sight.keyframe = index;
  sight.bearing_base = R_base_cam * bearing_cam;
  sight.root_base = information.llt().matrixU() * axes * R_base_cam.transpose();
  sight.sigma_rad = std::sqrt(2 / information.trace());
  return sight;
}

/// The same place, known as well as a landmark's match is.
Sight asMatch(Sight sight, const FlightRecord& record) {
  // A track has two of them, which err alike.
  const double sigma_rad = std::sqrt(2.0) * record.config.track_sigma_px /
                           record.keyframes[sight.keyframe].focal_length_px;
  const Eigen::Vector3d across = sight.bearing_base.unitOrthogonal();
  sight.root_base.row(0) = across / sigma_rad;
  sight.root_base.row(1) = sight.bearing_base.cross(across) / sigma_rad;
  sight.sigma_rad = sigma_rad;
  return sight;
}

struct MapRay {
  Eigen::Vector3d origin_map, direction_map;
};

MapRay rayOf(const Sight& sight, const FlightRecord& record) {
  const Keyframe& keyframe = record.keyframes[sight.keyframe];
  return {keyframe.T_map_base * keyframe.T_base_cam.translation(),
          keyframe.T_map_base.linear() * sight.bearing_base};
}

/// Where the rays meet, each weighed by the angle that it is off. Not finite where they do not.
Eigen::Vector3d meetingPoint(const std::vector<MapRay>& rays) {
  constexpr int kRounds = 3;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  for (int round = 0; round < kRounds; ++round) {
    Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
    Eigen::Vector3d b = Eigen::Vector3d::Zero();
    for (const MapRay& ray : rays) {
      const double weight = round == 0 ? 1 : 1 / (point - ray.origin_map).squaredNorm();
      const Eigen::Matrix3d across = weight * (Eigen::Matrix3d::Identity() -
                                               ray.direction_map * ray.direction_map.transpose());
      A += across;
      b += across * ray.origin_map;
    }
    point = A.ldlt().solve(b);
  }
  return point;
}

/// Puts the point where its sights meet. @return whether they are enough, and it lies in front of
/// all, near all rays, and is seen from places far enough apart
bool place(const FlightRecord& record, TrackPoint3d& point) {
  if (point.sights.size() < kFewestViews) return false;
  std::vector<MapRay> rays;
  rays.reserve(point.sights.size());
  double parallax_rad = 0;
  for (const Sight& sight : point.sights) {
    rays.push_back(rayOf(sight, record));
    parallax_rad =
        std::max(parallax_rad, rays.front().direction_map.cross(rays.back().direction_map).norm());
  }
  if (parallax_rad < kLeastParallax * point.sights.front().sigma_rad) return false;
  point.position_map = meetingPoint(rays);
  const double most_rad = point.is_joint ? kOffLandmark_rad : kOffTrack_rad;
  return std::all_of(rays.begin(), rays.end(), [&](const MapRay& ray) {
    const Eigen::Vector3d offset = point.position_map - ray.origin_map;
    return ray.direction_map.dot(offset) > 0 &&
           ray.direction_map.cross(offset).norm() < most_rad * offset.norm();
  });
}

using Sights = std::vector<Sight>;

/// The sights of each track.
std::map<std::uint32_t, Sights> tracksOf(const FlightRecord& record) {
  std::map<std::uint32_t, Sights> tracks;
  for (std::size_t k = 0; k < record.keyframes.size(); ++k) {
    for (const KeyframeView& view : record.keyframes[k].views)
      tracks[view.track_id].push_back(sightOf(view, k, record.keyframes[k]));
  }
  return tracks;
}

/// The landmark that a track shows; the last one where they became one.
std::unordered_map<std::uint32_t, std::uint32_t> landmarksOf(const FlightRecord& record) {
  std::unordered_map<std::uint32_t, std::uint32_t> of_track;
  for (const Keyframe& keyframe : record.keyframes) {
    for (const LandmarkTrack& seen : keyframe.landmarks) of_track[seen.track_id] = seen.landmark_id;
  }
  return of_track;
}

/// Of a landmark that all these tracks show.
TrackPoint3d jointPoint(std::uint32_t landmark_id, const std::vector<const Sights*>& tracks,
                        const FlightRecord& record) {
  TrackPoint3d point;
  point.landmark_id = landmark_id;
  point.is_joint = true;
  for (const Sights* sights : tracks) {
    point.sights.push_back(asMatch(sights->front(), record));
    if (sights->size() > 1) point.sights.push_back(asMatch(sights->back(), record));
  }
  return point;
}

double distance_m(const TrackPoint3d& point, const Sight& sight, const FlightRecord& record) {
  return (point.position_map - rayOf(sight, record).origin_map).norm();
}

/// How far away what each keyframe sees is, in the median; 0: it sees few points.
std::vector<double> distances_m(const FlightRecord& record,
                                const std::vector<TrackPoint3d>& points) {
  std::vector<std::vector<double>> seen_m(record.keyframes.size());
  for (const TrackPoint3d& point : points) {
    for (const Sight& sight : point.sights)
      seen_m[sight.keyframe].push_back(distance_m(point, sight, record));
  }
  std::vector<double> medians_m;
  for (const std::vector<double>& one : seen_m)
    medians_m.push_back(one.size() < kFewPoints ? 0 : quantile(one, 0.5));
  return medians_m;
}

/// The nearest entry that is not 0; the number of entries when there is none.
std::size_t nearestKnown(const std::vector<double>& values, std::size_t index) {
  const std::size_t count = values.size();
  for (std::size_t off = 0; off < count; ++off) {
    if (index + off < count && values[index + off] > 0) return index + off;
    if (off <= index && values[index - off] > 0) return index - off;
  }
  return count;
}

/// Of these tracks those that a keyframe with few points sees.
void addPresumed(const FlightRecord& record, const std::vector<const Sights*>& tracks,
                 std::vector<TrackPoint3d>& points) {
  const std::vector<double> known_m = distances_m(record, points);
  const std::size_t placed = points.size();
  std::vector<bool> is_compared(record.keyframes.size(), false);
  for (const Sights* sights : tracks) {
    const bool is_wanted = std::any_of(sights->begin(), sights->end(), [&](const Sight& sight) {
      return known_m[sight.keyframe] == 0;
    });
    if (!is_wanted || sights->size() < kFewestPresumedViews) continue;
    const std::size_t near = nearestKnown(known_m, sights->front().keyframe);
    if (near == known_m.size()) continue;
    is_compared[near] = true;
    TrackPoint3d point;
    point.is_presumed = true;
    point.distance_m = known_m[near];
    point.sights = *sights;
    const MapRay first = rayOf(sights->front(), record);
    point.position_map = first.origin_map + point.distance_m * first.direction_map;
    points.push_back(std::move(point));
  }
  for (std::size_t i = 0; i < placed; ++i) {
    TrackPoint3d& point = points[i];
    if (std::any_of(point.sights.begin(), point.sights.end(),
                    [&](const Sight& sight) { return is_compared[sight.keyframe]; }))
      point.distance_m = distance_m(point, point.sights.front(), record);
  }
}

}  // namespace

std::vector<TrackPoint3d> pointsOf(const FlightRecord& record) {
  const std::map<std::uint32_t, Sights> tracks = tracksOf(record);
  const auto landmark_of_track = landmarksOf(record);
  std::map<std::uint32_t, std::vector<const Sights*>> of_landmark;
  std::vector<TrackPoint3d> points;
  std::vector<const Sights*> without_parallax;
  for (const auto& [id, sights] : tracks) {
    const auto found = landmark_of_track.find(id);
    TrackPoint3d point;
    point.sights = sights;
    if (found != landmark_of_track.end()) {
      point.landmark_id = found->second;
      of_landmark[found->second].push_back(&sights);
    }
    if (place(record, point)) {
      points.push_back(std::move(point));
    } else {
      without_parallax.push_back(&sights);
    }
  }
  for (const auto& [id, its_tracks] : of_landmark) {
    if (its_tracks.size() < 2) continue;
    TrackPoint3d point = jointPoint(id, its_tracks, record);
    if (place(record, point)) points.push_back(std::move(point));
  }
  addPresumed(record, without_parallax, points);
  return points;
}

}  // namespace ardrone_vslam
