// SPDX-License-Identifier: BSD-3-Clause
#include "outputs/debug_image.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace ardrone_vslam {
namespace {

constexpr int kRedAge_frames = 10;
constexpr int kRadius_px = 3;

cv::Scalar colourOf(int age_frames) {
  const double share = std::min(1.0, static_cast<double>(age_frames) / kRedAge_frames);
  const double blue = 255 * std::max(0.0, 1 - 2 * share);
  const double red = 255 * std::max(0.0, 2 * share - 1);
  return {blue, 255 - blue - red, red};
}

}  // namespace

cv::Mat drawFeatures(const cv::Mat& grey, const ImageFeatures& features) {
  cv::Mat drawn;
  cv::cvtColor(grey, drawn, cv::COLOR_GRAY2BGR);
  for (std::size_t i = 0; i < features.size(); ++i) {
    const cv::Point centre(cvRound(features.pixel_px[i].x()), cvRound(features.pixel_px[i].y()));
    cv::circle(drawn, centre, kRadius_px, colourOf(features.age_frames[i]), 1, cv::LINE_AA);
  }
  return drawn;
}

}  // namespace ardrone_vslam
