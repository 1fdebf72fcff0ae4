// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "ardrone_vslam/camera_model.hpp"
#include "ardrone_vslam/image_view.hpp"

namespace ardrone_vslam::bench {

/// Frames that follow one another, and the camera that took them. Measurements go through them in
/// turn: of a single image the branch predictor would learn every corner.
struct Frames {
  std::vector<cv::Mat> images;  ///< 8-bit grey, without padding
  CameraIntrinsics camera;

  const cv::Mat& at(std::size_t i) const { return images[i % images.size()]; }
  ImageView view(std::size_t i) const {
    const cv::Mat& image = at(i);
    return {image.data, image.cols, image.rows, static_cast<std::ptrdiff_t>(image.step)};
  }
};

/// The folder that the environment variable ARDRONE_VSLAM_DATA names; nothing where it is unset or
/// empty: then all frames are rendered.
std::optional<std::string> dataFolder();

/// `camera` for images of another size that show the same.
CameraIntrinsics resized(CameraIntrinsics camera, int width_px, int height_px);

/// 24 frames of a street, 1242x375 (KITTI 03), or of the synthetic room in that size. Read once.
const Frames& streetFrames();

/// The same, resized to 320x240 as the AR.Drone 2.0's own tracker would see it.
const Frames& smallFrames();

}  // namespace ardrone_vslam::bench
