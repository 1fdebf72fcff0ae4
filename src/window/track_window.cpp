// SPDX-License-Identifier: BSD-3-Clause
#include "window/track_window.hpp"

#include <Eigen/LU>
#include <algorithm>

#include "linear/median.hpp"
#include "window/rays.hpp"

namespace ardrone_vslam {

TrackWindow::Track* TrackWindow::Tracks::find(std::uint32_t id) {
  const auto track =
      std::lower_bound(tracks.begin(), tracks.end(), id,
                       [](const Track& one, std::uint32_t other) { return one.id < other; });
  return track != tracks.end() && track->id == id ? &*track : nullptr;
}

void TrackWindow::Tracks::take(const Track& track, const Tracks& from) {
  tracks.push_back(track);
  tracks.back().first = static_cast<std::uint32_t>(observations.size());
  const auto first = from.observations.begin() + track.first;
  observations.insert(observations.end(), first, first + track.count);
}

const TrackWindow::Observation* TrackWindow::Tracks::viewOf(const Track& track,
                                                            std::uint32_t frame_id) const {
  for (std::uint32_t i = track.first + track.count; i-- > track.first;)
    if (observations[i].frame_id == frame_id) return &observations[i];
  return nullptr;
}

TrackWindow::Common TrackWindow::commonWith(std::uint32_t frame_id, const ImageFeatures& features,
                                            const TrackOrder& order) {
  pairs_.clear();
  int lost = 0;
  const TrackedFeature* seen = order.begin();
  for (const Track& track : now_.tracks) {
    const Observation* then = now_.viewOf(track, frame_id);
    if (then == nullptr) continue;
    while (seen != order.end() && seen->track_id < track.id) ++seen;
    if (seen == order.end() || seen->track_id != track.id) {
      ++lost;
      continue;
    }
    pairs_.push_back(
        {then->bearing_rig, R_rig_cam_ * features.bearing_cam[seen->feature].cast<double>()});
  }
  return {pairs_, lost};
}

TrackWindow::Motion TrackWindow::motionSince(const Clone& frame, const Clone& present,
                                             const ImageFeatures& features,
                                             const TrackOrder& order) {
  const Common common = commonWith(frame.id, features, order);
  Motion motion;
  motion.lost = common.lost;
  motion.common = static_cast<int>(common.pairs.size());
  if (common.pairs.empty()) return motion;
  const Eigen::Matrix3d R_then_now = frame.R_map_rig.transpose() * present.R_map_rig;
  moved_px_.clear();
  for (const BearingPair& pair : common.pairs)
    moved_px_.push_back((R_then_now * pair.now - pair.then).norm() * features.focal_length_px);
  motion.median_px = medianOf(moved_px_);
  return motion;
}

/// In the camera's axes.
RayRoot TrackWindow::rootOf(const ImageFeatures& features, std::size_t feature) const {
  const Eigen::Vector3d bearing_cam = features.bearing_cam[feature].cast<double>();
  const double focal_px = features.focal_length_px;
  if (features.information.empty() || features.information[feature].empty())
    return rayRoot(bearing_cam, corner_sigma_px_ / focal_px);
  const PixelInformation& known = features.information[feature];
  Eigen::Matrix2d information;
  information << known.xx_per_px2, known.xy_per_px2, known.xy_per_px2, known.yy_per_px2;
  const Eigen::Matrix2d scene_px2 = scene_sigma_px_ * scene_sigma_px_ * Eigen::Matrix2d::Identity();
  information = (information.inverse() + scene_px2).inverse().eval();
  return rayRoot(bearing_cam, information * (focal_px * focal_px));
}

void TrackWindow::add(std::uint32_t frame_id, const ImageFeatures& features,
                      const TrackOrder& order) {
  keyframe_id_ = frame_id;
  next_.tracks.clear();
  next_.observations.clear();
  auto known = now_.tracks.begin();
  for (const TrackedFeature& seen : order) {
    for (; known != now_.tracks.end() && known->id < seen.track_id; ++known)
      next_.take(*known, now_);
    Track begun;
    begun.id = seen.track_id;
    const bool goes_on = known != now_.tracks.end() && known->id == seen.track_id;
    next_.take(goes_on ? *known++ : begun, now_);
    Track& track = next_.tracks.back();
    next_.observations.push_back({frame_id,
                                  R_rig_cam_ * features.bearing_cam[seen.feature].cast<double>(),
                                  rootOf(features, seen.feature) * R_rig_cam_.transpose()});
    ++track.count;
    track.descriptor = features.descriptor[seen.feature];
  }
  for (; known != now_.tracks.end(); ++known) next_.take(*known, now_);
  std::swap(now_, next_);
}

void TrackWindow::assignLandmark(std::uint32_t track_id, std::uint32_t landmark_id) {
  if (Track* track = now_.find(track_id)) track->landmark_id = landmark_id;
}

const std::vector<FinishedTrack>& TrackWindow::takeFinished(const std::vector<Clone>& frames,
                                                            bool oldest_goes) {
  const std::uint32_t newest_id = frames.back().id;
  const std::uint32_t oldest_id = frames.front().id;
  finished_.clear();
  finished_views_.clear();
  finished_views_.reserve(now_.observations.size());  // the tracks below point into it
  const auto takeEnded = [&](const Track& track) {
    const bool has_ended = now_.newest(track).frame_id != newest_id;
    const bool spans = oldest_goes && now_.oldest(track).frame_id == oldest_id;
    if (!has_ended && !spans) return false;
    const std::size_t first_view = finished_views_.size();
    std::size_t frame = 0;
    for (std::uint32_t i = track.first; i < track.first + track.count; ++i) {
      while (frames[frame].id != now_.observations[i].frame_id) ++frame;
      finished_views_.push_back(
          {frame, now_.observations[i].bearing_rig, now_.observations[i].root_rig});
    }
    finished_.push_back({track.id,
                         {finished_views_.data() + first_view, track.count},
                         track.descriptor,
                         track.landmark_id});
    return has_ended;
  };
  auto& tracks = now_.tracks;
  tracks.erase(std::remove_if(tracks.begin(), tracks.end(), takeEnded), tracks.end());
  return finished_;
}

void TrackWindow::keepNewestView(std::uint32_t track_id) {
  Track* track = now_.find(track_id);
  if (track == nullptr) return;
  track->first += track->count - 1;
  track->count = 1;
}

void TrackWindow::dropFrame(std::uint32_t frame_id) {
  for (Track& track : now_.tracks) {
    if (now_.oldest(track).frame_id != frame_id) continue;
    ++track.first;
    --track.count;
  }
  auto& tracks = now_.tracks;
  tracks.erase(std::remove_if(tracks.begin(), tracks.end(),
                              [](const Track& track) { return track.count == 0; }),
               tracks.end());
}

}  // namespace ardrone_vslam
