// SPDX-License-Identifier: BSD-3-Clause
#include "arc_corners.hpp"

#include <algorithm>
#include <array>

#include "kernels/fast/fast_circle.hpp"

namespace ardrone_vslam::reproduction {
namespace {

using kernels::kCircle;
using kernels::kCircleRadiusPx;
using kernels::kCircleSize;

std::array<std::ptrdiff_t, kCircleSize> offsetsIn(const cv::Mat& image) {
  std::array<std::ptrdiff_t, kCircleSize> offsets{};
  for (std::size_t n = 0; n < offsets.size(); ++n)
    offsets[n] = kCircle[n].y_px * static_cast<std::ptrdiff_t>(image.step[0]) + kCircle[n].x_px;
  return offsets;
}

/// The longest run around the circle of pixels beyond the threshold to one side.
template <class Conforms>
bool hasArc(int arc_length_px, const Conforms& conforms) {
  int run = 0;
  for (int n = 0; n < kCircleSize + arc_length_px - 1; ++n) {
    run = conforms(n % kCircleSize) ? run + 1 : 0;
    if (run == arc_length_px) return true;
  }
  return false;
}

/// The largest threshold at which the pixel is a corner; below 1: at none.
int scoreOf(const std::array<int, kCircleSize>& differences, int arc_length_px) {
  int score = 0;
  for (int first = 0; first < kCircleSize; ++first) {
    int brighter = 255, darker = 255;
    for (int i = 0; i < arc_length_px; ++i) {
      const int difference = differences[static_cast<std::size_t>((first + i) % kCircleSize)];
      brighter = std::min(brighter, difference);
      darker = std::min(darker, -difference);
    }
    score = std::max({score, brighter - 1, darker - 1});
  }
  return score;
}

template <class Visit>
void forInnerPixels(const cv::Mat& image, const Visit& visit) {
  for (int y = kCircleRadiusPx; y < image.rows - kCircleRadiusPx; ++y)
    for (int x = kCircleRadiusPx; x < image.cols - kCircleRadiusPx; ++x) visit(x, y);
}

/// Whether no neighbour is as good.
bool isMaximum(const cv::Mat& scores, int x, int y) {
  const std::int16_t own = scores.at<std::int16_t>(y, x);
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx)
      if ((dx != 0 || dy != 0) && scores.at<std::int16_t>(y + dy, x + dx) >= own) return false;
  return true;
}

}  // namespace

std::vector<Corner> arcCorners(const cv::Mat& image, int arc_length_px, int threshold) {
  const auto offsets = offsetsIn(image);
  cv::Mat scores(image.size(), CV_16SC1, cv::Scalar(0));
  forInnerPixels(image, [&](int x, int y) {
    const std::uint8_t* centre = image.ptr(y) + x;
    std::array<int, kCircleSize> differences{};
    for (std::size_t n = 0; n < offsets.size(); ++n)
      differences[n] = int{centre[offsets[n]]} - int{*centre};
    const int score = scoreOf(differences, arc_length_px);
    if (score >= threshold) scores.at<std::int16_t>(y, x) = static_cast<std::int16_t>(score);
  });
  std::vector<Corner> corners;
  forInnerPixels(image, [&](int x, int y) {
    const std::int16_t own = scores.at<std::int16_t>(y, x);
    if (own == 0 || !isMaximum(scores, x, y)) return;
    corners.push_back({static_cast<std::int16_t>(x), static_cast<std::int16_t>(y),
                       static_cast<std::uint8_t>(own)});
  });
  return corners;
}

int countArcCorners(const cv::Mat& image, int arc_length_px, int threshold) {
  const auto offsets = offsetsIn(image);
  int count = 0;
  forInnerPixels(image, [&](int x, int y) {
    const std::uint8_t* centre = image.ptr(y) + x;
    const auto pixel = [&](int n) { return int{centre[offsets[static_cast<std::size_t>(n)]]}; };
    const bool is_corner =
        hasArc(arc_length_px, [&](int n) { return pixel(n) > *centre + threshold; }) ||
        hasArc(arc_length_px, [&](int n) { return pixel(n) < *centre - threshold; });
    if (is_corner) ++count;
  });
  return count;
}

}  // namespace ardrone_vslam::reproduction
