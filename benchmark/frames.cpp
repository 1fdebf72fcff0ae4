// SPDX-License-Identifier: BSD-3-Clause
#include "frames.hpp"

#include <cstdlib>
#include <opencv2/imgproc.hpp>

#include "sequences/sequence.hpp"
#include "world/world_sequence.hpp"

namespace ardrone_vslam::bench {
namespace {

constexpr std::size_t kFrames = 24;
constexpr int kStreetWidth_px = 1242;
constexpr int kStreetHeight_px = 375;

Frames firstFramesOf(Sequence& sequence) {
  Frames frames;
  frames.camera = sequence.camera();
  for (std::size_t i = 0; i < kFrames; ++i) frames.images.push_back(sequence.image(i));
  return frames;
}

Frames resized(const Frames& frames, int width_px, int height_px) {
  Frames result;
  result.camera = bench::resized(frames.camera, width_px, height_px);
  for (const cv::Mat& image : frames.images) {
    cv::Mat small;
    cv::resize(image, small, {width_px, height_px}, 0, 0, cv::INTER_AREA);
    result.images.push_back(small);
  }
  return result;
}

Frames renderedStreet() {
  WorldOptions options;
  options.duration_s = 1;
  WorldSequence world(options);
  return resized(firstFramesOf(world), kStreetWidth_px, kStreetHeight_px);
}

}  // namespace

std::optional<std::string> dataFolder() {
  const char* folder = std::getenv("ARDRONE_VSLAM_DATA");
  if (folder == nullptr || *folder == '\0') return std::nullopt;
  return folder;
}

CameraIntrinsics resized(CameraIntrinsics camera, int width_px, int height_px) {
  const double sx = static_cast<double>(width_px) / camera.width_px;
  const double sy = static_cast<double>(height_px) / camera.height_px;
  camera.width_px = width_px;
  camera.height_px = height_px;
  camera.fx_px *= sx;
  camera.cx_px = (camera.cx_px + 0.5) * sx - 0.5;
  camera.fy_px *= sy;
  camera.cy_px = (camera.cy_px + 0.5) * sy - 0.5;
  return camera;
}

const Frames& streetFrames() {
  static const Frames frames = [] {
    const auto folder = dataFolder();
    return folder ? firstFramesOf(*openFolder(*folder + "/kitti_03")) : renderedStreet();
  }();
  return frames;
}

const Frames& smallFrames() {
  static const Frames frames = resized(streetFrames(), 320, 240);
  return frames;
}

}  // namespace ardrone_vslam::bench
