// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "ardrone_vslam/features.hpp"
#include "matching/track_order.hpp"
#include "odometry/image_rotation.hpp"
#include "window/clone.hpp"
#include "window/track_views.hpp"

namespace ardrone_vslam {

/// A track that may be used: its views, and what its point would need to become a landmark.
struct FinishedTrack {
  std::uint32_t track_id = 0;     ///< ImageFeatures::track_id
  TrackViews views;               ///< held by the TrackWindow until it is asked again
  Descriptor descriptor;          ///< of its last view
  std::uint32_t landmark_id = 0;  ///< of the landmark it belongs to, 0: none
};

/// The tracks through the frames of the window. Tracks ascend in their id, and their observations
/// lie one behind the other, so that each of these steps is one pass: O(tracks and features), and
/// nothing is allocated once there have been as many.
class TrackWindow {
 public:
  /// @param R_rig_cam  of the extrinsics
  /// @param corner_sigma_px  sigma of features that are not aligned
  /// @param scene_sigma_px  of the others, beside what their information tells
  TrackWindow(const Eigen::Matrix3d& R_rig_cam, double corner_sigma_px, double scene_sigma_px)
      : R_rig_cam_(R_rig_cam), corner_sigma_px_(corner_sigma_px), scene_sigma_px_(scene_sigma_px) {}
  /// Of the features from now on. None of them may have the track of an earlier one.
  void changeCamera(const Eigen::Matrix3d& R_rig_cam) { R_rig_cam_ = R_rig_cam; }

  /// The tracks of a frame of the window that go on, and those that do not.
  struct Common {
    const std::vector<BearingPair>& pairs;  ///< axes of the rig; until the next call
    int lost = 0;                           ///< of all that the window still has
  };
  /// @param order  of these features
  Common commonWith(std::uint32_t frame_id, const ImageFeatures& features, const TrackOrder& order);

  /// How far the image has moved since a frame of the window, once its turning is taken out.
  struct Motion {
    double median_px = 0;  ///< of the common tracks
    int common = 0;        ///< tracks of that frame that go on
    int lost = 0;          ///< and those that do not
  };
  /// @param order  of these features
  Motion motionSince(const Clone& frame, const Clone& present, const ImageFeatures& features,
                     const TrackOrder& order);

  /// Appends a view to the track of each feature: the frame is a keyframe.
  void add(std::uint32_t frame_id, const ImageFeatures& features, const TrackOrder& order);
  /// The frame added last; 0: none.
  std::uint32_t keyframeId() const { return keyframe_id_; }
  /// A track belongs to a landmark; unknown tracks are ignored.
  void assignLandmark(std::uint32_t track_id, std::uint32_t landmark_id);

  /// Takes out the tracks that ended before the newest frame, and adds what those that began in the
  /// oldest one have so far when that frame is to go. Ascending in track id.
  const std::vector<FinishedTrack>& takeFinished(const std::vector<Clone>& frames,
                                                 bool oldest_goes);
  /// A track that goes on has been used: only its newest view is left for later.
  void keepNewestView(std::uint32_t track_id);
  /// The oldest frame leaves the window.
  void dropFrame(std::uint32_t frame_id);

 private:
  struct Observation {
    std::uint32_t frame_id;
    Eigen::Vector3d bearing_rig;
    RayRoot root_rig;
  };
  struct Track {
    std::uint32_t id = 0;
    std::uint32_t landmark_id = 0;
    std::uint32_t first = 0;  // of its observations in Tracks::observations
    std::uint32_t count = 0;  // at least one
    Descriptor descriptor;
  };
  struct Tracks {
    std::vector<Track> tracks;
    std::vector<Observation>
        observations;  // also of tracks and views that are gone, until the next add()

    const Observation& oldest(const Track& track) const { return observations[track.first]; }
    const Observation& newest(const Track& track) const {
      return observations[track.first + track.count - 1];
    }
    /// Null: the frame did not see it. The newest views are found first.
    const Observation* viewOf(const Track& track, std::uint32_t frame_id) const;
    Track* find(std::uint32_t id);
    /// Appends a track and its observations of another store.
    void take(const Track& track, const Tracks& from);
  };

  RayRoot rootOf(const ImageFeatures& features, std::size_t feature) const;

  Eigen::Matrix3d R_rig_cam_;
  double corner_sigma_px_;
  double scene_sigma_px_;
  std::uint32_t keyframe_id_ = 0;
  Tracks now_;
  Tracks next_;  // add() builds it and changes it for the other
  std::vector<FinishedTrack> finished_;
  std::vector<TrackView> finished_views_;
  std::vector<BearingPair> pairs_;
  std::vector<double> moved_px_;
};

}  // namespace ardrone_vslam
