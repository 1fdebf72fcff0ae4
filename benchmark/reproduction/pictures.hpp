// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "ardrone_vslam/image_view.hpp"
#include "match_metrics.hpp"

namespace ardrone_vslam::reproduction {

struct NamedPicture {
  std::string name;
  cv::Mat image;  ///< 8-bit grey
};

/// The thesis's 512x512 pictures that are at hand; without the data folder rendered views.
std::vector<NamedPicture> thesisPictures(bool quick);

/// Two pictures of the same wall, and which pixels show the same.
struct PicturePair {
  std::string what;
  cv::Mat first, second;
  quality::PairGeometry geometry;
};

/// graf 1-2 (800x640); without the data folder two views of the synthetic room. Lives on.
const PicturePair& wallPictures();

/// A video of a drone's small camera, 320x240: the kitchen's images, or a rendered flight with
/// noise and motion blur.
/// @param what  receives what it is
std::vector<cv::Mat> smallVideo(std::size_t frames, std::string& what);

inline ImageView viewOf(const cv::Mat& image) {
  return {image.data, image.cols, image.rows, static_cast<std::ptrdiff_t>(image.step[0])};
}

/// White Gaussian noise, seeded.
cv::Mat withNoise(const cv::Mat& image, double sigma_grey, std::uint64_t seed);

}  // namespace ardrone_vslam::reproduction
