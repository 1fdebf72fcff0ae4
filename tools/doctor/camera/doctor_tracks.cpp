// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/camera/doctor_tracks.hpp"

#include <algorithm>
#include <memory>

#include "ardrone_vslam/tracker.hpp"
#include "doctor/camera/doctor_camera.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::size_t kStretch = 90;  // images on end

/// Slow cameras' images are far apart.
TrackerConfig trackerConfig() {
  TrackerConfig config;
  config.corners.features_per_frame = 400;
  config.tracks.search_radius_px = 80;
  return config;
}

/// One tracker after the other, as the camera changes.
class TrackingCamera {
 public:
  void see(const cv::Mat& image, const std::string& frame, const CameraIntrinsics& camera,
           std::int64_t stamp_ns, std::vector<CameraTracks>& cameras) {
    const bool is_same = tracker_ && frame == frame_ && camera == tracker_->camera().intrinsics();
    if (!is_same) {
      const std::uint32_t next = tracker_ ? tracker_->nextTrackId() : 1;
      tracker_ = std::make_unique<Tracker>(trackerConfig(), camera, next);
      frame_ = frame;
    }
    const ImageView view{image.data, image.cols, image.rows,
                         static_cast<std::ptrdiff_t>(image.step)};
    tracker_->process(view, stamp_ns, features_);
    const auto isThis = [&](const CameraTracks& c) {
      return c.frame == frame && c.camera == camera;
    };
    auto tracks = std::find_if(cameras.begin(), cameras.end(), isThis);
    if (tracks == cameras.end()) {
      cameras.push_back({frame, camera, {}});
      tracks = cameras.end() - 1;
    }
    ImageFeatures kept;
    kept.stamp_ns = stamp_ns;
    kept.width_px = features_.width_px;
    kept.height_px = features_.height_px;
    kept.focal_length_px = features_.focal_length_px;
    kept.pixel_px = features_.pixel_px;
    kept.bearing_cam = features_.bearing_cam;
    kept.track_id = features_.track_id;
    tracks->images.push_back(std::move(kept));
  }

 private:
  std::unique_ptr<Tracker> tracker_;
  std::string frame_;
  ImageFeatures features_;
};

}  // namespace

std::vector<std::size_t> imagesToTrack(std::size_t images, std::size_t most) {
  std::vector<std::size_t> chosen;
  if (images <= most) {
    for (std::size_t i = 0; i < images; ++i) chosen.push_back(i);
    return chosen;
  }
  const std::size_t stretches = std::max<std::size_t>(1, most / kStretch);
  const std::size_t length = most / stretches;
  for (std::size_t s = 0; s < stretches; ++s) {
    const std::size_t first = stretches == 1 ? 0 : s * (images - length) / (stretches - 1);
    for (std::size_t i = 0; i < length; ++i) chosen.push_back(first + i);
  }
  return chosen;
}

Tracks trackImages(const DoctorRecording& recording,
                   const std::function<void(std::size_t done)>& progress) {
  Tracks tracks;
  TrackingCamera camera;
  std::int64_t newest_ns = 0;
  std::size_t done = 0;
  for (const std::size_t i : imagesToTrack(recording.images.size())) {
    if (progress) progress(++done);
    const DoctorImage& image = recording.images[i];
    const auto calibration = calibrationOf(recording, i);
    if (!image.fault.empty() || !calibration || image.time.stamp_ns <= newest_ns) continue;
    const DoctorCalibration& c = recording.calibrations[*calibration];
    const CameraIntrinsics& intrinsics = usedCamera(c);
    const bool is_refused = !c.fault.empty() && !needsRescaling(c);
    if (is_refused || !isPlausible(intrinsics) || intrinsics.width_px != image.width_px ||
        intrinsics.height_px != image.height_px) {
      continue;
    }
    const cv::Mat grey = recording.grey(i);
    if (grey.cols != image.width_px || grey.rows != image.height_px) {
      ++tracks.undecodable;
      continue;
    }
    newest_ns = image.time.stamp_ns;
    camera.see(grey, image.frame, intrinsics, newest_ns, tracks.cameras);
    ++tracks.looked_at;
  }
  return tracks;
}

}  // namespace ardrone_vslam
