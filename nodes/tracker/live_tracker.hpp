// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/CameraInfo.h>

#include <memory>
#include <optional>
#include <string>

#include "ardrone_vslam/tracker.hpp"
#include "configs/node_config.hpp"
#include "images/image_input.hpp"
#include "stamps/stage_timer.hpp"
#include "timing/warning_limiter.hpp"
#include "tracker/image_receiver.hpp"
#include "with_ros/camera_info_conversion.hpp"

namespace ardrone_vslam {

/// For what a tracker is told before it has one.
CameraIntrinsics anyCamera();

/// What of the tracker's parameters may change in flight.
struct TrackerChanges {
  CornerDetectorConfig corners;
  FrameTrackerConfig tracks;
};

template <class Visitor>
void visitParameters(TrackerChanges& c, Visitor&& visit) {
  visitParameters(c.corners, visit);
  visitParameters(c.tracks, visit);
}

/// The Tracker that fits the camera of the images that come.
class LiveTracker {
 public:
  /// @param images  whose topics are named when something is wrong
  LiveTracker(const TrackerNodeConfig& node_config, const TrackerConfig& config,
              const ImageReceiver& images, Warnings& warnings);

  /// Makes the tracker that fits camera and image.
  /// @return why there is none, and what helps: the image must be dropped
  std::string prepare(const sensor_msgs::CameraInfo& info, const std::string& frame,
                      const GreyImage& image);
  /// From the next image on; tracks begin anew.
  /// @throws ConfigError; std::invalid_argument where the camera's images do not allow it
  void change(const TrackerChanges& changes);
  /// The tracks end: time began again.
  void reset() { tracker_.reset(); }
  /// @pre prepare() has found no fault
  void process(const GreyImage& image, std::int64_t stamp_ns, std::optional<float> rotation_rad);

  /// Of the image processed last.
  const ImageFeatures& features() const { return features_; }
  double milliseconds(Stage stage) const { return times_ms_[static_cast<std::size_t>(stage)]; }
  const std::string& cameraFrame() const { return camera_frame_; }

 private:
  /// Of an image that the calibration is not for; else empty.
  std::string imageFault(const CameraIntrinsics& camera, const std::string& frame,
                         const GreyImage& image) const;

  TrackerNodeConfig node_config_;
  TrackerConfig config_;
  const ImageReceiver& images_;
  Warnings& warnings_;
  std::unique_ptr<Tracker> tracker_;
  std::uint32_t next_track_id_;  // goes on when a new tracker is made
  CameraIntrinsics camera_;
  std::string camera_frame_;
  ImageFeatures features_;
  StageTimes_ms times_ms_{};
};

}  // namespace ardrone_vslam
