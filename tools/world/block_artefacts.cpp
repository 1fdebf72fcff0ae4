// SPDX-License-Identifier: BSD-3-Clause
#include "world/block_artefacts.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>

namespace ardrone_vslam {
namespace {

constexpr int kBlock_px = 4;

using Block = Eigen::Matrix4f;

/// Rows are the cosines of an orthonormal transform.
Block cosines() {
  Block c;
  for (int k = 0; k < kBlock_px; ++k) {
    for (int x = 0; x < kBlock_px; ++x) {
      c(k, x) = static_cast<float>(std::sqrt((k == 0 ? 1.0 : 2.0) / kBlock_px) *
                                   std::cos(M_PI * k * (x + 0.5) / kBlock_px));
    }
  }
  return c;
}

/// Mean of the pixels above and to the left; mid-grey without any.
float prediction(const cv::Mat& image, int left, int top) {
  int sum = 0, count = 0;
  for (int i = 0; i < kBlock_px; ++i) {
    if (top > 0) sum += image.at<std::uint8_t>(top - 1, left + i);
    if (left > 0) sum += image.at<std::uint8_t>(top + i, left - 1);
    count += (top > 0 ? 1 : 0) + (left > 0 ? 1 : 0);
  }
  return count == 0 ? 128.0F : static_cast<float>(sum) / static_cast<float>(count);
}

}  // namespace

void addBlockArtefacts(int quantiser, cv::Mat& image) {
  static const Block kCosines = cosines();
  constexpr float kDeadZone = 1.0F / 3;  // what is rounded up begins a third above a whole step
  const auto step = static_cast<float>(0.625 * std::pow(2, quantiser / 6.0));
  for (int top = 0; top + kBlock_px <= image.rows; top += kBlock_px) {
    for (int left = 0; left + kBlock_px <= image.cols; left += kBlock_px) {
      const float predicted = prediction(image, left, top);
      Block block;
      for (int i = 0; i < kBlock_px * kBlock_px; ++i) {
        block(i / 4, i % 4) =
            static_cast<float>(image.at<std::uint8_t>(top + i / 4, left + i % 4)) - predicted;
      }
      const Block levels = (kCosines * block * kCosines.transpose() / step).unaryExpr([](float x) {
        return std::copysign(std::floor(std::abs(x) + kDeadZone), x);
      });
      block = kCosines.transpose() * (levels * step) * kCosines;
      for (int i = 0; i < kBlock_px * kBlock_px; ++i) {
        const float grey = std::min(std::max(block(i / 4, i % 4) + predicted, 0.0F), 255.0F);
        image.at<std::uint8_t>(top + i / 4, left + i % 4) =
            static_cast<std::uint8_t>(std::lround(grey));
      }
    }
  }
}

}  // namespace ardrone_vslam
