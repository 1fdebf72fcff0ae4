// SPDX-License-Identifier: BSD-3-Clause
#include "track_measurement.hpp"

#include <Eigen/LU>
#include <cmath>
#include <optional>
#include <unordered_map>

#include "ardrone_vslam/tracker.hpp"
#include "epipolar.hpp"
#include "refinement.hpp"

namespace ardrone_vslam::bench {
namespace {

/// A feature of one image.
struct TrackPoint {
  PlanePoint at;
  std::optional<Eigen::Matrix2d> variance_px2;  // nothing: not aligned
  int age_frames = 0;
};

/// By track id.
using TrackPoints = std::unordered_map<std::uint32_t, TrackPoint>;

std::optional<Eigen::Matrix2d> varianceOf(const ImageFeatures& features, std::size_t i) {
  if (features.information.empty() || features.information[i].empty()) return std::nullopt;
  const PixelInformation& told = features.information[i];
  Eigen::Matrix2d information;
  information << told.xx_per_px2, told.xy_per_px2, told.xy_per_px2, told.yy_per_px2;
  return information.inverse();
}

TrackPoints pointsOf(const CameraModel& camera, const ImageFeatures& features) {
  TrackPoints points;
  for (std::size_t i = 0; i < features.size(); ++i) {
    const auto at = planePointOf(camera, features.pixel_px[i].cast<double>());
    if (!at) continue;
    points[features.track_id[i]] = {*at, varianceOf(features, i), features.age_frames[i]};
  }
  return points;
}

std::vector<TrackPoints> trackedPoints(const TrueSequence& sequence, bool align_tracks) {
  TrackerConfig config;
  config.align_tracks = align_tracks;
  config.corners.features_per_frame = kFeatures;
  Tracker tracker(config, sequence.camera);
  ImageFeatures features;
  std::vector<TrackPoints> result;
  for (const cv::Mat& image : sequence.images) {
    const ImageView view{image.data, image.cols, image.rows,
                         static_cast<std::ptrdiff_t>(image.step)};
    tracker.process(view, static_cast<std::int64_t>(result.size() + 1), features);
    result.push_back(pointsOf(tracker.camera(), features));
  }
  return result;
}

void countAligned(const TrackPoints& points, TrackMeasurement& measurement) {
  for (const auto& [id, point] : points) {
    if (point.age_frames == 0) continue;
    ++measurement.continued;
    if (point.variance_px2) ++measurement.aligned;
  }
}

/// A track in two images.
struct TrackPair {
  const TrackPoint* first;
  const TrackPoint* second;

  PointPair points() const { return {first->at, second->at}; }
};

std::vector<TrackPair> pairsOf(const TrackPoints& first, const TrackPoints& second) {
  std::vector<TrackPair> pairs;
  for (const auto& [id, point] : second) {
    const auto found = first.find(id);
    if (found != first.end()) pairs.push_back({&found->second, &point});
  }
  return pairs;
}

/// @return nothing where the camera stood still: then there are no epipolar lines
std::optional<RelativePose> trueRelativePose(const Eigen::Isometry3d& T_world_first,
                                             const Eigen::Isometry3d& T_world_second) {
  constexpr double kLeast_m = 0.002;
  const Eigen::Isometry3d T_second_first = T_world_second.inverse() * T_world_first;
  const double length_m = T_second_first.translation().norm();
  if (length_m < kLeast_m) return std::nullopt;
  return RelativePose{T_second_first.linear(), T_second_first.translation() / length_m};
}

std::optional<RelativePose> refinedOn(const std::vector<TrackPair>& pairs,
                                      const RelativePose& truth) {
  std::vector<PointPair> points;
  points.reserve(pairs.size());
  for (const TrackPair& pair : pairs) points.push_back(pair.points());
  return refined(truth, points);
}

void addDistances(const std::vector<TrackPair>& pairs, const RelativePose& pose,
                  std::size_t which_apart, TruthMeasurement& measurement) {
  Distances& distances = measurement.apart[which_apart];
  for (const TrackPair& pair : pairs) {
    const EpipolarDistance distance = epipolarDistance(pose, pair.points());
    distances.all_px.push_back(distance.sampson_px);
    if (!pair.first->variance_px2 || !pair.second->variance_px2) continue;
    distances.aligned_px.push_back(distance.sampson_px);
    // Only where it begins is a track where it is by definition.
    if (pair.first->age_frames != 0) continue;
    const double claimed_px2 = distance.normal.dot(*pair.second->variance_px2 * distance.normal);
    distances.claims.push_back({std::sqrt(claimed_px2), distance.second_px});
  }
}

}  // namespace

TrackMeasurement measureTracks(const TrueSequence& sequence, bool align_tracks) {
  const std::vector<TrackPoints> points = trackedPoints(sequence, align_tracks);
  TrackMeasurement result;
  for (std::size_t second = 0; second < points.size(); ++second) {
    countAligned(points[second], result);
    for (std::size_t k = 0; k < kImagesApart.size() && kImagesApart[k] <= second; ++k) {
      const std::size_t first = second - kImagesApart[k];
      const auto truth =
          trueRelativePose(sequence.T_world_cam[first], sequence.T_world_cam[second]);
      if (!truth) continue;
      const std::vector<TrackPair> pairs = pairsOf(points[first], points[second]);
      addDistances(pairs, *truth, k, result.own);
      if (const auto pose = refinedOn(pairs, *truth)) addDistances(pairs, *pose, k, result.refined);
    }
  }
  return result;
}

}  // namespace ardrone_vslam::bench
