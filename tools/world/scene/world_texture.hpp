// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <opencv2/core.hpp>
#include <vector>

namespace ardrone_vslam {

/// A grey picture with its reductions by 2, 4, 8 .., so that a pixel that covers many texels costs
/// no more than one that covers few, and nothing aliases. Positions are in texels of level 0, the
/// middle of the first texel at (0.5, 0.5).
class MipTexture {
 public:
  /// @param picture  8-bit grey. It is continued to the right and below up to whole texels of the
  /// coarsest level, so that all levels lie exactly upon each other.
  explicit MipTexture(const cv::Mat& picture);

  /// Grey value seen by a pixel whose neighbours to the right and below see `step_x` and `step_y`
  /// texels further. Where one step is longer than the other (a floor seen flat) up to kMaxProbes
  /// samples along it keep the other direction sharp. Outside the border texels are continued.
  float sample(const Eigen::Vector2f& at, const Eigen::Vector2f& step_x,
               const Eigen::Vector2f& step_y) const {
    const float length_x = step_x.norm();
    const float length_y = step_y.norm();
    const bool along_x = length_x > length_y;
    const float longer = along_x ? length_x : length_y;
    const float shorter = along_x ? length_y : length_x;
    int probes = 1;
    while (probes < kMaxProbes && longer > 1.25F * shorter * static_cast<float>(probes)) ++probes;
    const float spacing = 1 / static_cast<float>(probes);
    const float level = log2Of(std::max(shorter, longer * spacing)) + kBlurLevels;
    if (probes == 1) return trilinear(at, level);
    const Eigen::Vector2f step = (along_x ? step_x : step_y) * spacing;
    Eigen::Vector2f probe = at - 0.5F * static_cast<float>(probes - 1) * step;
    float sum = 0;
    for (int i = 0; i < probes; ++i, probe += step) sum += trilinear(probe, level);
    return sum * spacing;
  }

  static constexpr int kMaxProbes = 4;

 private:
  /// A lens is a little less sharp than its pixels; without this small marks would seem to move by
  /// a twentieth of a pixel with where they fall between the pixels.
  static constexpr float kBlurLevels = 0.3F;

  struct Level {
    cv::Mat picture;
    float scale;  // texels of this level in one of level 0
    float max_x;
    float max_y;
  };

  /// Within 0.09 of log2(x): exact at the powers of two, straight between them. @pre x > 0, normal
  static float log2Of(float x) {
    std::int32_t bits = 0;
    std::memcpy(&bits, &x, sizeof(bits));
    return static_cast<float>(bits) * 0x1.0p-23F - 127;
  }

  float trilinear(const Eigen::Vector2f& at, float level) const {
    if (level <= 0) return bilinear(levels_.front(), at);
    const auto last = static_cast<float>(levels_.size() - 1);
    if (level >= last) return bilinear(levels_.back(), at);
    const auto fine = static_cast<std::size_t>(level);
    const float share = level - static_cast<float>(fine);
    return (1 - share) * bilinear(levels_[fine], at) + share * bilinear(levels_[fine + 1], at);
  }

  static float bilinear(const Level& level, const Eigen::Vector2f& at) {
    const float x = std::min(std::max(at.x() * level.scale - 0.5F, 0.0F), level.max_x);
    const float y = std::min(std::max(at.y() * level.scale - 0.5F, 0.0F), level.max_y);
    const int column = static_cast<int>(x);
    const int row = static_cast<int>(y);
    const float fx = x - static_cast<float>(column);
    const float fy = y - static_cast<float>(row);
    const std::uint8_t* upper = level.picture.ptr<std::uint8_t>(row) + column;
    const std::uint8_t* lower = upper + level.picture.step[0];
    const float above = static_cast<float>(upper[0]) * (1 - fx) + static_cast<float>(upper[1]) * fx;
    const float below = static_cast<float>(lower[0]) * (1 - fx) + static_cast<float>(lower[1]) * fx;
    return above * (1 - fy) + below * fy;
  }

  std::vector<Level> levels_;
};

/// A square of grain that is repeated in all directions, each second time mirrored so that it has
/// no seams.
class Grain {
 public:
  /// @param picture  8-bit grey about a mean of 128
  Grain(const cv::Mat& picture, double texels_per_m)
      : texture_(picture),
        texels_per_m_(static_cast<float>(texels_per_m)),
        size_(static_cast<float>(std::min(picture.rows, picture.cols))) {}

  /// What is added to the surface's own grey there; steps as MipTexture's, but all in metres.
  float sample(const Eigen::Vector2f& at_m, const Eigen::Vector2f& step_x_m,
               const Eigen::Vector2f& step_y_m) const {
    const Eigen::Vector2f at(fold(at_m.x() * texels_per_m_), fold(at_m.y() * texels_per_m_));
    return texture_.sample(at, step_x_m * texels_per_m_, step_y_m * texels_per_m_) - 128;
  }

 private:
  float fold(float texel) const {
    const float in_pair = texel - 2 * size_ * std::floor(texel / (2 * size_));
    return std::min(in_pair, 2 * size_ - in_pair);
  }

  MipTexture texture_;
  float texels_per_m_;
  float size_;
};

}  // namespace ardrone_vslam
