// SPDX-License-Identifier: BSD-3-Clause
#include "world/scene/world_paint.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace ardrone_vslam {
namespace {

constexpr int kFixedBits = 4;  // fraction of OpenCV's drawing coordinates

int toTexels(double metres) {
  return static_cast<int>(std::lround(metres * Painter::kTexelsPerMetre));
}

}  // namespace

Painter::Painter(double width_m, double height_m, std::uint64_t seed, std::uint64_t stream)
    : width_m_(width_m),
      height_m_(height_m),
      random_(seed, stream),
      picture_(toTexels(height_m), toTexels(width_m), CV_8UC1, cv::Scalar(128)) {}

cv::Rect Painter::texels(const cv::Rect2d& area) const {
  const int left = toTexels(area.x), top = toTexels(area.y);
  const cv::Rect wanted(left, top, toTexels(area.x + area.width) - left,
                        toTexels(area.y + area.height) - top);
  return wanted & cv::Rect(0, 0, picture_.cols, picture_.rows);
}

cv::Point Painter::fixedPoint(const cv::Point2d& at) const {
  // Metres count from the corner of the first texel, OpenCV's coordinates from its middle.
  const auto fixed = [](double metres) {
    return static_cast<int>(std::lround((metres * kTexelsPerMetre - 0.5) * (1 << kFixedBits)));
  };
  return {fixed(at.x), fixed(at.y)};
}

void Painter::fill(const cv::Rect2d& area, double grey) {
  picture_(texels(area)).setTo(cv::Scalar(std::min(std::max(grey, 0.0), 255.0)));
}

void Painter::polygon(const std::vector<cv::Point2d>& corners, double grey) {
  std::vector<cv::Point> points;
  for (const auto& corner : corners) points.push_back(fixedPoint(corner));
  cv::fillPoly(picture_, std::vector<std::vector<cv::Point>>{points}, cv::Scalar(grey), cv::LINE_AA,
               kFixedBits);
}

void Painter::ellipse(const cv::Point2d& middle, const cv::Size2d& half_axes, double angle_deg,
                      double grey) {
  const auto fixed = [](double metres) {
    return static_cast<int>(std::lround(metres * kTexelsPerMetre * (1 << kFixedBits)));
  };
  cv::ellipse(picture_, fixedPoint(middle),
              cv::Size(fixed(half_axes.width), fixed(half_axes.height)), angle_deg, 0, 360,
              cv::Scalar(grey), cv::FILLED, cv::LINE_AA, kFixedBits);
}

void Painter::line(const cv::Point2d& from, const cv::Point2d& to, double width_m, double grey) {
  cv::line(picture_, fixedPoint(from), fixedPoint(to), cv::Scalar(grey),
           std::max(1, toTexels(width_m)), cv::LINE_AA, kFixedBits);
}

void Painter::lettering(const cv::Rect2d& area, double grey) {
  static const std::string letters = "ABCDEFGHJKLMNPQRSTUVWXYZ0123456789   ";
  cv::Mat target = picture_(texels(area));
  if (target.empty()) return;
  const double scale = 0.7 * target.rows / 21.0;  // Hershey's capitals are 21 high at scale 1
  const int thickness = std::max(1, static_cast<int>(std::lround(scale * random_.uniform(1, 4))));
  const auto count = static_cast<int>(target.cols / (17 * scale));
  std::string text;
  for (int i = 0; i < count; ++i) {
    text +=
        letters[static_cast<std::size_t>(random_.integer(0, static_cast<int>(letters.size()) - 1))];
  }
  const int face = random_.chance(0.5) ? cv::FONT_HERSHEY_SIMPLEX : cv::FONT_HERSHEY_TRIPLEX;
  cv::putText(target, text, cv::Point(1, static_cast<int>(0.85 * target.rows)), face, scale,
              cv::Scalar(grey), thickness, cv::LINE_AA);
}

void Painter::noise(const cv::Rect2d& area, double largest_m, double amplitude, double persistence,
                    double stretch) {
  cv::Mat target = picture_(texels(area));
  if (target.empty()) return;
  cv::Mat sum(target.size(), CV_32FC1, cv::Scalar(0));
  cv::Mat octave;
  for (double patch = largest_m * kTexelsPerMetre; patch >= 1; patch /= 2) {
    const int rows = std::max(2, static_cast<int>(std::ceil(target.rows / patch)));
    const int cols = std::max(2, static_cast<int>(std::ceil(target.cols / (patch * stretch))));
    cv::Mat coarse(rows, cols, CV_32FC1);
    for (int y = 0; y < rows; ++y) {
      for (int x = 0; x < cols; ++x) {
        coarse.at<float>(y, x) = static_cast<float>(amplitude * random_.normal());
      }
    }
    cv::resize(coarse, octave, target.size(), 0, 0, cv::INTER_CUBIC);
    sum += octave;
    amplitude *= persistence;
  }
  cv::add(target, sum, target, cv::noArray(), CV_8U);
}

}  // namespace ardrone_vslam
