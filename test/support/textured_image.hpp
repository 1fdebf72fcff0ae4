// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "support/grey_images.hpp"

namespace ardrone_vslam::test {

/// A smooth random texture that can be rendered at any place between pixels: waves of 7 to 30 px.
class Texture {
 public:
  explicit Texture(unsigned seed) {
    std::mt19937 random(seed);
    for (Wave& wave : waves_) {
      const double length_px = uniformInt(random, 70, 300) / 10.0;
      const double direction = uniformInt(random, 0, 6283) / 1000.0;
      wave = {2 * M_PI / length_px * std::cos(direction),
              2 * M_PI / length_px * std::sin(direction), uniformInt(random, 0, 6283) / 1000.0};
    }
  }

  /// About -60 .. 60.
  double at(double x_px, double y_px) const {
    double sum = 0;
    for (const Wave& wave : waves_) sum += std::sin(wave.x * x_px + wave.y * y_px + wave.phase);
    return sum * 60 / std::sqrt(2.0 * kWaves);
  }

  /// An image that shows, at its pixel (x, y), the texture's place (x - dx, y - dy).
  GreyImage image(int width_px, int height_px, double dx_px, double dy_px, double gain = 1,
                  double middle = 128, int noise = 0, unsigned seed = 1) const {
    return noisyImage(width_px, height_px, noise, seed,
                      [&](int x, int y) { return middle + gain * at(x - dx_px, y - dy_px); });
  }

  /// The image without a shift, turned (from x to y) and grown about its middle.
  GreyImage rotatedImage(int width_px, int height_px, double rotation_rad, double growth, int noise,
                         unsigned seed) const {
    const double c = std::cos(rotation_rad) / growth;
    const double s = std::sin(rotation_rad) / growth;
    return noisyImage(width_px, height_px, noise, seed, [&](int x_px, int y_px) {
      const double x = x_px - width_px / 2.0;
      const double y = y_px - height_px / 2.0;
      return 128 + at(width_px / 2.0 + c * x + s * y, height_px / 2.0 - s * x + c * y);
    });
  }

 private:
  template <class Level>
  static GreyImage noisyImage(int width_px, int height_px, int noise, unsigned seed,
                              const Level& level_at) {
    GreyImage image(width_px, height_px, 5);
    std::mt19937 random(seed);
    for (int y = 0; y < height_px; ++y) {
      for (int x = 0; x < width_px; ++x) {
        const double level = level_at(x, y) + (noise > 0 ? uniformInt(random, -noise, noise) : 0);
        image.at(x, y) = static_cast<std::uint8_t>(std::clamp(std::lround(level), 0L, 255L));
      }
    }
    return image;
  }

  static constexpr int kWaves = 12;
  struct Wave {
    double x, y, phase;
  };
  Wave waves_[kWaves];
};

}  // namespace ardrone_vslam::test
