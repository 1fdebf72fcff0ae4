// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "ardrone_vslam/features.hpp"
#include "ardrone_vslam/image_view.hpp"
#include "freak/freak_selected_pairs.hpp"

namespace ardrone_vslam::test {

/// FREAK of one keypoint at the pattern's own scale straight from its definition: no table, no
/// integral image.
class FreakOracle {
 public:
  FreakOracle(const ImageView& image, int x_px, int y_px)
      : image_(image), x_px_(x_px), y_px_(y_px) {}

  Descriptor upright() const { return compare(means(0)); }

  Descriptor oriented() const {
    constexpr std::array<std::array<int, 2>, 9> kPairs{
        {{0, 3}, {1, 4}, {2, 5}, {0, 2}, {1, 3}, {2, 4}, {3, 5}, {4, 0}, {5, 1}}};
    const Means mean = means(0);
    int sum_x = 0;
    int sum_y = 0;
    for (int ring = 0; ring < 7; ++ring) {
      for (std::size_t k = 0; k < (ring < 4 ? 9U : 3U); ++k) {
        const int i = 6 * ring + kPairs[k][0];
        const int j = 6 * ring + kPairs[k][1];
        const Point a = point(i, 0);
        const Point b = point(j, 0);
        const float dx = a.x - b.x;
        const float dy = a.y - b.y;
        const float norm_squared = dx * dx + dy * dy;
        const int difference =
            mean[static_cast<std::size_t>(i)] - mean[static_cast<std::size_t>(j)];
        sum_x += difference * static_cast<int>(std::lround(dx / norm_squared * 4096.0)) / 2048;
        sum_y += difference * static_cast<int>(std::lround(dy / norm_squared * 4096.0)) / 2048;
      }
    }
    const auto angle_deg =
        static_cast<float>(std::atan2(double(sum_y), double(sum_x)) * (180.0 / kPi));
    return compare(
        means((static_cast<int>(std::lrint(256.0 * double(angle_deg) / 360.0)) + 256) % 256));
  }

 private:
  static constexpr double kPi = 3.14159265358979323846;
  using Means = std::array<int, 43>;
  struct Point {
    float x, y, sigma;
  };

  static Point point(int index, int orientation) {
    constexpr std::array<int, 7> kUnits{0, 6, 11, 15, 18, 20, 21};
    const int ring = index / 6;
    const double unit = (2.0 / 3.0 - 2.0 / 24.0) / 21.0;
    const auto ringRadius = [&](int r) {
      return r == 6 ? 2.0 / 24.0 : 2.0 / 3.0 - kUnits[static_cast<std::size_t>(r)] * unit;
    };
    const double radius = ring == 7 ? 0.0 : ringRadius(ring);
    const double sigma = ringRadius(std::min(ring, 6)) / 2.0;
    const double alpha =
        (index % 6) * 2 * kPi / 6 + (ring % 2) * kPi / 6 + orientation * 2 * kPi / 256;
    return {static_cast<float>(radius * std::cos(alpha) * 22.0),
            static_cast<float>(radius * std::sin(alpha) * 22.0), static_cast<float>(sigma * 22.0)};
  }

  Means means(int orientation) const {
    Means result{};
    for (int index = 0; index < 43; ++index) {
      const Point p = point(index, orientation);
      const float x = p.x + static_cast<float>(x_px_);
      const float y = p.y + static_cast<float>(y_px_);
      const int left = static_cast<int>(std::lrint(x - p.sigma));
      const int top = static_cast<int>(std::lrint(y - p.sigma));
      const int right = static_cast<int>(std::lrint(x + p.sigma + 1.F));
      const int bottom = static_cast<int>(std::lrint(y + p.sigma + 1.F));
      const int area = (right - left) * (bottom - top);
      int sum = 0;
      for (int row = top; row < bottom; ++row) {
        for (int column = left; column < right; ++column) sum += image_.at(column, row);
      }
      result[static_cast<std::size_t>(index)] = (sum + area / 2) / area;
    }
    return result;
  }

  static Descriptor compare(const Means& mean) {
    std::vector<std::array<std::size_t, 2>> pairs;
    for (std::size_t i = 1; i < 43; ++i) {
      for (std::size_t j = 0; j < i; ++j) pairs.push_back({i, j});
    }
    Descriptor descriptor;
    for (std::size_t byte = 0; byte < 64; ++byte) {
      for (std::size_t bit = 0; bit < 8; ++bit) {
        const auto& pair =
            pairs[kFreakSelectedPairs[128 * (byte / 16) + 16 * bit + 15 - byte % 16]];
        const std::uint64_t value = mean[pair[0]] >= mean[pair[1]] ? 1 : 0;
        descriptor.words[byte / 8] |= value << (8 * (byte % 8) + bit);
      }
    }
    return descriptor;
  }

  ImageView image_;
  int x_px_, y_px_;
};

}  // namespace ardrone_vslam::test
