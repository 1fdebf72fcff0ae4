// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/track_window.hpp"

#include <algorithm>

namespace ardrone_vslam {

TrackWindow::Motion TrackWindow::motionSince(const WindowPose& frame, const WindowPose& present,
                                             const ImageFeatures& features) const {
  const Eigen::Matrix3d R_frame_cam =
      frame.R_map_base.transpose() * present.R_map_base * R_base_cam_;
  std::vector<double> moved_px;
  for (std::size_t i = 0; i < features.size(); ++i) {
    const auto track = tracks_.find(features.track_id[i]);
    if (track == tracks_.end() || track->second.sightings.back().frame_id != frame.id) continue;
    const Eigen::Vector3d now = R_frame_cam * features.bearing_cam[i].cast<double>();
    moved_px.push_back((now - track->second.sightings.back().bearing_base).norm() *
                       features.focal_length_px);
  }
  Motion motion;
  motion.common = static_cast<int>(moved_px.size());
  for (const auto& [id, track] : tracks_)
    motion.lost += track.sightings.back().frame_id == frame.id ? 1 : 0;
  motion.lost -= motion.common;
  if (moved_px.empty()) return motion;
  const auto middle = moved_px.begin() + static_cast<std::ptrdiff_t>(moved_px.size() / 2);
  std::nth_element(moved_px.begin(), middle, moved_px.end());
  motion.median_px = *middle;
  return motion;
}

void TrackWindow::add(std::uint32_t frame_id, const ImageFeatures& features) {
  for (std::size_t i = 0; i < features.size(); ++i) {
    if (features.track_id[i] == kNoTrack) continue;
    Track& track = tracks_[features.track_id[i]];
    track.sightings.push_back({frame_id, R_base_cam_ * features.bearing_cam[i].cast<double>()});
    track.descriptor = features.descriptor[i];
  }
}

void TrackWindow::assignLandmark(std::uint32_t track_id, std::uint32_t landmark_id) {
  const auto track = tracks_.find(track_id);
  if (track != tracks_.end()) track->second.landmark_id = landmark_id;
}

std::vector<FinishedTrack> TrackWindow::takeFinished(const std::vector<WindowPose>& frames,
                                                     bool oldest_goes) {
  const std::uint32_t newest_id = frames.back().id;
  const std::uint32_t oldest_id = frames.front().id;
  std::vector<FinishedTrack> finished;
  for (auto entry = tracks_.begin(); entry != tracks_.end();) {
    Track& track = entry->second;
    const bool has_ended = track.sightings.back().frame_id != newest_id;
    const bool spans = oldest_goes && track.sightings.front().frame_id == oldest_id;
    if (!has_ended && !spans) {
      ++entry;
      continue;
    }
    FinishedTrack result;
    result.track_id = entry->first;
    result.descriptor = track.descriptor;
    result.landmark_id = track.landmark_id;
    std::size_t frame = 0;
    for (const Sighting& sighting : track.sightings) {
      while (frames[frame].id != sighting.frame_id) ++frame;
      result.views.push_back({frame, sighting.bearing_base});
    }
    finished.push_back(std::move(result));
    entry = has_ended ? tracks_.erase(entry) : std::next(entry);
  }
  std::sort(finished.begin(), finished.end(),
            [](const FinishedTrack& a, const FinishedTrack& b) { return a.track_id < b.track_id; });
  return finished;
}

void TrackWindow::keepNewestView(std::uint32_t track_id) {
  const auto entry = tracks_.find(track_id);
  if (entry == tracks_.end()) return;
  auto& sightings = entry->second.sightings;
  sightings.erase(sightings.begin(), sightings.end() - 1);
}

void TrackWindow::dropFrame(std::uint32_t frame_id) {
  for (auto entry = tracks_.begin(); entry != tracks_.end();) {
    auto& sightings = entry->second.sightings;
    if (sightings.front().frame_id == frame_id) sightings.erase(sightings.begin());
    entry = sightings.empty() ? tracks_.erase(entry) : std::next(entry);
  }
}

}  // namespace ardrone_vslam
