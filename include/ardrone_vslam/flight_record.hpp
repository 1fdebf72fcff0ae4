// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "ardrone_vslam/features.hpp"
#include "ardrone_vslam/frame_result.hpp"
#include "ardrone_vslam/landmark.hpp"
#include "ardrone_vslam/odometry_buffer.hpp"
#include "ardrone_vslam/shared_blocks.hpp"
#include "ardrone_vslam/slam_config.hpp"

namespace ardrone_vslam {

/// Where a keyframe saw the point of a track.
struct KeyframeView {
  std::uint32_t track_id = 0;                                  ///< ImageFeatures::track_id
  Eigen::Vector3f bearing_cam = Eigen::Vector3f::UnitZ();      ///< unit vector, optical frame
  Eigen::Matrix2f information_rad2 = Eigen::Matrix2f::Zero();  ///< along columns and rows
};

/// A frame on the way to a keyframe that the filter may keep a pose of.
struct PassedFrame {
  std::int64_t stamp_ns = 0;                                      ///< of its image
  Eigen::Isometry3d T_odom_base = Eigen::Isometry3d::Identity();  ///< as Keyframe has it
};

/// A track that showed a landmark.
struct LandmarkTrack {
  std::uint32_t track_id = 0;     ///< ImageFeatures::track_id
  std::uint32_t landmark_id = 0;  ///< Landmark::id
};

/// What a batch optimisation needs of one keyframe.
struct Keyframe {
  std::int64_t stamp_ns = 0;                                     ///< of its image
  Eigen::Isometry3d T_map_base = Eigen::Isometry3d::Identity();  ///< as fused at that image
  /// By the odometry, jumps of its position left out.
  Eigen::Isometry3d T_odom_base = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d T_base_cam = Eigen::Isometry3d::Identity();  ///< extrinsics
  double focal_length_px = 0;                                    ///< ImageFeatures has it
  /// Of the way since the keyframe before, per axis, by white noise of the odometry and by jumps.
  double way_variance_m2 = 0;
  double way_m = 0;                 ///< length of that way
  std::optional<double> height_m;   ///< above the floor, as the filter has used one since the last
  int floor = 0;                    ///< which one, from 0 on
  std::vector<KeyframeView> views;  ///< of tracks that go on; at the first keyframe of all
  std::vector<LandmarkTrack> landmarks;  ///< seen since the keyframe before
  std::vector<PassedFrame> passed;       ///< since the keyframe before, oldest first
};

/// What a flight in one piece has told about its way and its map, for refinement afterwards.
struct FlightRecord {
  /// What the filter believed, the odometry's noise as learned at last.
  MsckfConfig config;
  SharedBlocks<Keyframe, 16> keyframes;  ///< oldest first
  /// False, and then nothing else is here: the flight began anew on its way, or was looked for in a
  /// map, or found elsewhere in its own.
  bool is_whole = true;
};

/// Keeps what a FlightRecord has, frame by frame.
class FlightRecorder {
 public:
  /// @param T_base_cam  extrinsics of the first camera
  /// @param most_bytes  of the record: nothing is added from the first frame on that might not fit
  FlightRecorder(const SlamConfig& config, const Eigen::Isometry3d& T_base_cam,
                 std::size_t most_bytes = std::numeric_limits<std::size_t>::max());
  ~FlightRecorder();
  /// The next frame is another camera's.
  void useCamera(const Eigen::Isometry3d& T_base_cam);
  /// A frame that Slam::process() has answered, and the landmarks after it. O(landmarks)
  /// at keyframes.
  void see(const ImageFeatures& features, const OdometryState& odometry, const FrameResult& result,
           const Landmarks& landmarks);
  /// Up to the last frame.
  const FlightRecord& record() const;
  /// The same without a copy. There is nothing more to see then.
  FlightRecord take();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ardrone_vslam
