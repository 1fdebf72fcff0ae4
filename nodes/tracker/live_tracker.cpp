// SPDX-License-Identifier: BSD-3-Clause
#include "tracker/live_tracker.hpp"

#include <ros/time.h>

#include <stdexcept>
#include <utility>

#include "tracker/track_ids.hpp"

namespace ardrone_vslam {

CameraIntrinsics anyCamera() {
  CameraIntrinsics camera;
  camera.width_px = 640;
  camera.height_px = 480;
  camera.fx_px = camera.fy_px = 500;
  camera.cx_px = 320;
  camera.cy_px = 240;
  return camera;
}

LiveTracker::LiveTracker(const TrackerNodeConfig& node_config, const TrackerConfig& config,
                         const ImageReceiver& images, Warnings& warnings)
    : node_config_(node_config),
      config_(config),
      images_(images),
      warnings_(warnings),
      next_track_id_(firstTrackId(ros::WallTime::now().toNSec())) {}

std::string LiveTracker::prepare(const sensor_msgs::CameraInfo& info, const std::string& frame,
                                 const GreyImage& image) {
  const std::string& info_topic = images_.infoTopic();
  const auto checked =
      toIntrinsics(info, {node_config_.rectified, node_config_.rescale_calibration});
  if (!checked.value) return info_topic + ": camera " + frame + ": " + checked.fault;
  const CameraIntrinsics& camera = *checked.value;
  const std::string fault = imageFault(camera, frame, image);
  if (!fault.empty()) return images_.imageTopic() + ": " + fault;
  if (tracker_ && camera == camera_ && frame == camera_frame_) return {};
  if (tracker_) {
    warnings_.event("the camera changed from " + camera_frame_ + " to " + frame +
                    ": tracks begin anew");
  }
  try {
    tracker_ = std::make_unique<Tracker>(config_, camera, next_track_id_);
  } catch (const std::invalid_argument& e) {
    tracker_.reset();
    return info_topic + ": " + e.what();
  }
  const double scale = camera.fx_px / (node_config_.rectified ? info.P[0] : info.K[0]);
  if (scale != 1) {
    warnings_.event(text(info_topic, ": camera ", frame, ": the calibration is of images ",
                         1 / scale, " times as wide: taken for them (rescale_calibration)"));
  }
  camera_ = camera;
  camera_frame_ = frame;
  return {};
}

void LiveTracker::change(const TrackerChanges& changes) {
  TrackerConfig wanted = config_;
  wanted.corners = changes.corners;
  wanted.tracks = changes.tracks;
  auto tracker =
      std::make_unique<Tracker>(wanted, tracker_ ? camera_ : anyCamera(), next_track_id_);
  if (tracker_) tracker_ = std::move(tracker);
  config_ = wanted;
}

std::string LiveTracker::imageFault(const CameraIntrinsics& camera, const std::string& frame,
                                    const GreyImage& image) const {
  const cv::Mat& pixels = image.pixels;
  if (camera.width_px != pixels.cols || camera.height_px != pixels.rows)
    return "camera " + frame + ": its image is " + std::to_string(pixels.cols) + "x" +
           std::to_string(pixels.rows) + " but " + images_.infoTopic() + " is for " +
           std::to_string(camera.width_px) + "x" + std::to_string(camera.height_px) +
           "; calibrate the camera at the size it streams";
  if (frame.empty()) return "it names no frame_id; give the camera's optical frame";
  return {};
}

void LiveTracker::process(const GreyImage& image, std::int64_t stamp_ns,
                          std::optional<float> rotation_rad) {
  times_ms_ = {};
  StageTimer timer(times_ms_);
  tracker_->process(image.view(), stamp_ns, features_, timer.hook(), rotation_rad);
  next_track_id_ = tracker_->nextTrackId();
}

}  // namespace ardrone_vslam
