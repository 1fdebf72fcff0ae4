// SPDX-License-Identifier: BSD-3-Clause
#include "msckf/track_update.hpp"

#include <algorithm>
#include <cmath>

#include "linear/median.hpp"
#include "linear/scalars.hpp"

namespace ardrone_vslam {

/// A track that passed its gate, and how far it is trusted.
struct TrackUpdate::Candidate {
  const FinishedTrack* track;
  TrackResidual residual;
  double weight;
  double ray_information_rad2;  // of one of its rays
};

namespace {

constexpr int kFewestViews = 3;        // two tell a point, but nothing of the frames
constexpr double kParallaxSigmas = 6;  // of a ray: below, the depth is not Gaussian
// A baseline that is known worse across than by this share of its length tells no depth.
constexpr double kBaselineUncertainty = 0.5;
// Of a point from the floor; the height's own error is in it, and what lies about.
constexpr double kFloorPointSigma_m = 0.1;

template <class Candidate>
void sum(const std::vector<Candidate>& candidates, Information& information) {
  information.matrix.setZero();
  information.vector.setZero();
  for (const Candidate& c : candidates) {
    if (c.weight > 0) c.residual.addTo(information, c.weight);
  }
  information.matrix.triangularView<Eigen::StrictlyUpper>() = information.matrix.transpose();
}

/// From the oldest frame that saw one of these tracks to the newest one. The rest of the window
/// they correct by its covariance with these.
template <class Candidate>
Information nothingYetOf(const std::vector<Candidate>& candidates) {
  int first = candidates.front().residual.views.front().coordinate;
  int last = first;
  for (const Candidate& c : candidates) {
    first = std::min(first, c.residual.views.front().coordinate);
    last = std::max(last, c.residual.views.back().coordinate);
  }
  return Information::between(first, last + WindowState::kFrame);
}

/// Wrong tracks may pass a gate as wide as the prior, but they do not agree with the others: their
/// weight falls with what is left of their residual (Geman and McClure), at last to 0 or 1.
/// @return whether the information is that of the tracks that agree
template <class Candidate>
bool agree(const WindowState& state, std::vector<Candidate>& candidates, Information& information) {
  for (const bool is_last : {false, true}) {
    sum(candidates, information);
    const auto error = state.preview(information);
    if (!error) return false;
    for (Candidate& c : candidates) {
      const double left = c.residual.squaredRest(*error, information.coordinates.front());
      const int dof = c.residual.degreesOfFreedom();
      c.weight = is_last ? (left < chiSquare95(dof) ? 1 : 0) : 1 / squared(1 + left / dof);
    }
  }
  sum(candidates, information);
  return true;
}

/// Whether the way between a track's first and last view is well enough known to triangulate.
bool hasKnownBaseline(TrackViews views, const WindowState& state) {
  const std::size_t first = views.front().frame;
  const std::size_t last = views.back().frame;
  const Eigen::Matrix3d relative =
      state.relativeCovariance(state.frameCoordinate(first), state.frameCoordinate(last))
          .topLeftCorner<3, 3>();
  const Eigen::Vector3d baseline =
      state.frames()[last].position_map - state.frames()[first].position_map;
  const double length_m2 = baseline.squaredNorm();
  // Along it, it is a matter of scale, which does no harm.
  const double across_m2 = relative.trace() - baseline.dot(relative * baseline) / length_m2;
  return across_m2 < squared(kBaselineUncertainty) * length_m2;
}

/// The point of a track whose views tell the depth and more.
std::optional<TrackPoint> pointOf(TrackViews views, const Eigen::Vector3d& camera_rig,
                                  const WindowState& state) {
  if (static_cast<int>(views.size()) < kFewestViews || !hasKnownBaseline(views, state))
    return std::nullopt;
  auto point = triangulateTrack(state.frames(), camera_rig, views);
  if (point && point->parallax_rad < kParallaxSigmas * point->ray_sigma_rad) point.reset();
  return point;
}

/// UsedTrack::stretch_sigma.
double stretchSigma(TrackViews views, const Eigen::Vector3d& camera_rig, const WindowState& state) {
  const Clone& first = state.frames()[views.front().frame];
  const Clone& last = state.frames()[views.back().frame];
  const Eigen::Vector3d baseline = last.position_map + last.R_map_rig * camera_rig -
                                   first.position_map - first.R_map_rig * camera_rig;
  const double length_m = baseline.norm();
  // The bias has base's axes, but between them and the rig's there is only the extrinsics' error.
  const Eigen::Vector3d along_rig = last.R_map_rig.transpose() * baseline / length_m;
  constexpr int kBias = WindowState::kBias;
  const double variance = along_rig.dot(state.covariance().block<3, 3>(kBias, kBias) * along_rig);
  const double time_s = seconds(last.stamp_ns - first.stamp_ns);
  return std::sqrt(variance) * time_s / length_m;
}

/// With `floor_points`, of a track that ends below.
std::optional<FloorHeight> floorOf(TrackViews views, const HeightConfig& config,
                                   const WindowState& state) {
  if (!config.floor_points) return std::nullopt;
  constexpr double kDown = 0.7;  // cosine: 45 degrees
  const Clone& frame = state.frames()[views.back().frame];
  const double down = -(frame.R_map_rig * views.back().bearing_rig).z();
  if (!frame.height_m || down < kDown) return std::nullopt;
  return FloorHeight{*frame.height_m, kFloorPointSigma_m};
}

}  // namespace

void TrackUpdate::changeCamera(const Eigen::Vector3d& camera_rig) {
  // With no keyframe since the last change the tracks are still those of the camera before.
  if (!earlier_camera_rig_) earlier_camera_rig_ = camera_rig;
}

void TrackUpdate::skip() {
  used_.clear();
  candidates_ = 0;
  nis_ = 0;
}

void TrackUpdate::apply(const std::vector<FinishedTrack>& finished,
                        const Eigen::Vector3d& camera_rig, double focal_length_px,
                        std::uint32_t anchor_id, TrackWindow& tracks, WindowState& state) {
  skip();
  const Eigen::Vector3d seen_from_rig = earlier_camera_rig_.value_or(camera_rig);
  std::vector<Candidate> candidates = gate(finished, seen_from_rig, state);
  if (!candidates.empty() && correct(candidates, focal_length_px, state))
    collectUsed(candidates, seen_from_rig, anchor_id, tracks, state);
  if (earlier_camera_rig_) {  // all its tracks have ended, and this one sees something else
    earlier_camera_rig_.reset();
    point_distance_m_ = 0;
  }
}

std::vector<TrackUpdate::Candidate> TrackUpdate::gate(const std::vector<FinishedTrack>& finished,
                                                      const Eigen::Vector3d& camera_rig,
                                                      const WindowState& state) {
  std::vector<Candidate> candidates;
  double distances = 0;
  int degrees = 0;
  for (const FinishedTrack& track : finished) {
    const auto point = pointOf(track.views, camera_rig, state);
    if (!point) continue;
    auto residual = residualOf(state, camera_rig, track.views, *point);
    if (!residual) continue;
    ++candidates_;
    double distance = residual->distance(state);
    int dof = residual->degreesOfFreedom();
    if (!(distance < 2 * chiSquare95(dof))) continue;
    distances += distance;
    degrees += dof;
    if (const auto floor = floorOf(track.views, config_.height, state)) {
      auto on_floor = residualOf(state, camera_rig, track.views, *point, floor);
      const double with_floor = on_floor->distance(state);
      // Else it is on a table, or the height is that of one.
      if (with_floor - distance < chiSquare95(1)) {
        *residual = *std::move(on_floor);
        distance = with_floor;
        dof = residual->degreesOfFreedom();
      }
    }
    candidates.push_back({&track, std::move(*residual), 1 / squared(1 + distance / dof),
                          1 / squared(point->ray_sigma_rad)});
  }
  if (degrees > 0) nis_ = distances / degrees;
  return candidates;
}

bool TrackUpdate::correct(std::vector<Candidate>& candidates, double focal_length_px,
                          WindowState& state) const {
  Information information = nothingYetOf(candidates);
  if (!agree(state, candidates, information)) return false;
  double ray_information_rad2 = 0;
  for (const Candidate& c : candidates) ray_information_rad2 += c.weight * c.ray_information_rad2;
  // What calibration, rolling shutter and the scene do to the tracks of a keyframe they do to all
  // alike, so that it does not average out: together they have the variance of their rays' mean,
  // and that of the error they share.
  const double common_rad2 = squared(config_.track_common_px / focal_length_px);
  const double share = 1 / (1 + ray_information_rad2 * common_rad2);
  information.matrix *= share;
  information.vector *= share;
  return state.update(information);
}

void TrackUpdate::collectUsed(const std::vector<Candidate>& candidates,
                              const Eigen::Vector3d& camera_rig, std::uint32_t anchor_id,
                              TrackWindow& tracks, const WindowState& state) {
  const std::size_t anchor = *indexOf(state.frames(), anchor_id);
  std::vector<double> distances_m;
  for (const Candidate& c : candidates) {
    if (c.weight == 0) continue;
    tracks.keepNewestView(c.track->track_id);
    const auto point = triangulateTrack(state.frames(), camera_rig, c.track->views);
    if (!point) continue;
    const Eigen::Matrix3d by_frames =
        covarianceByFrames(state, camera_rig, c.track->views, point->position_map, anchor);
    used_.push_back({*c.track, *point, anchor_id, point->covariance_m2 + by_frames,
                     stretchSigma(c.track->views, camera_rig, state)});
    distances_m.push_back((point->position_map - state.newest().position_map).norm());
  }
  if (used_.empty()) return;
  point_distance_m_ = medianOf(distances_m);
}

}  // namespace ardrone_vslam
