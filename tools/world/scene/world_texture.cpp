// SPDX-License-Identifier: BSD-3-Clause
#include "world/scene/world_texture.hpp"

#include <cassert>
#include <opencv2/imgproc.hpp>

namespace ardrone_vslam {
namespace {

constexpr int kLevels = 7;
constexpr int kCoarsest = 1 << (kLevels - 1);  // texels of level 0 in one of the coarsest

int toWhole(int size) {
  // At least two texels are left at the coarsest level: bilinear sampling reads pairs.
  return std::max(2, (size + kCoarsest - 1) / kCoarsest) * kCoarsest;
}

cv::Mat halve(const cv::Mat& picture) {
  cv::Mat half(picture.rows / 2, picture.cols / 2, CV_8UC1);
  for (int y = 0; y < half.rows; ++y) {
    const auto* upper = picture.ptr<std::uint8_t>(2 * y);
    const auto* lower = picture.ptr<std::uint8_t>(2 * y + 1);
    auto* out = half.ptr<std::uint8_t>(y);
    for (int x = 0; x < half.cols; ++x) {
      const int sum = upper[2 * x] + upper[2 * x + 1] + lower[2 * x] + lower[2 * x + 1];
      out[x] = static_cast<std::uint8_t>((sum + 2) / 4);
    }
  }
  return half;
}

}  // namespace

MipTexture::MipTexture(const cv::Mat& picture) {
  assert(picture.type() == CV_8UC1 && !picture.empty() && "a texture is an 8-bit grey picture");
  cv::Mat level;
  cv::copyMakeBorder(picture, level, 0, toWhole(picture.rows) - picture.rows, 0,
                     toWhole(picture.cols) - picture.cols, cv::BORDER_REPLICATE);
  for (int i = 0; i < kLevels; ++i) {
    // Just below the last texel: its right and lower neighbour are still inside.
    const float max_x = std::nextafter(static_cast<float>(level.cols - 1), 0.0F);
    const float max_y = std::nextafter(static_cast<float>(level.rows - 1), 0.0F);
    levels_.push_back({level, 1.0F / static_cast<float>(1 << i), max_x, max_y});
    level = halve(level);
  }
}

}  // namespace ardrone_vslam
