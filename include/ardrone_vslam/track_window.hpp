// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "ardrone_vslam/features.hpp"
#include "ardrone_vslam/track_constraint.hpp"

namespace ardrone_vslam {

/// A track that may be used: its views, and what its point would need to become a landmark.
struct FinishedTrack {
  std::uint32_t track_id = 0;
  std::vector<TrackView> views;
  Descriptor descriptor;          ///< of its last view
  std::uint32_t landmark_id = 0;  ///< of the landmark it belongs to, 0: none
};

/// The tracks through the frames of the window.
class TrackWindow {
 public:
  /// @param R_base_cam  the camera's mounting
  explicit TrackWindow(const Eigen::Matrix3d& R_base_cam) : R_base_cam_(R_base_cam) {}

  /// How far the image has moved since a frame, once its turning is taken out.
  struct Motion {
    double median_px = 0;
    int common = 0;  ///< tracks of that frame that go on
    int lost = 0;    ///< and those that do not
  };
  Motion motionSince(const WindowPose& frame, const WindowPose& present,
                     const ImageFeatures& features) const;

  /// Appends a view to the track of each feature.
  void add(std::uint32_t frame_id, const ImageFeatures& features);
  /// A track belongs to a landmark; unknown tracks are ignored.
  void assignLandmark(std::uint32_t track_id, std::uint32_t landmark_id);

  /// Takes out the tracks that ended before the newest frame, and adds what those that began in the
  /// oldest one have so far when that frame is to go. Ascending in track id.
  std::vector<FinishedTrack> takeFinished(const std::vector<WindowPose>& frames, bool oldest_goes);
  /// A track that goes on has been used: only its newest view is left for later.
  void keepNewestView(std::uint32_t track_id);
  /// The oldest frame leaves the window.
  void dropFrame(std::uint32_t frame_id);

 private:
  struct Sighting {
    std::uint32_t frame_id;
    Eigen::Vector3d bearing_base;
  };
  struct Track {
    std::vector<Sighting> sightings;
    Descriptor descriptor;
    std::uint32_t landmark_id = 0;
  };

  Eigen::Matrix3d R_base_cam_;
  std::unordered_map<std::uint32_t, Track> tracks_;
};

}  // namespace ardrone_vslam
