// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "ardrone_vslam/image_view.hpp"

namespace ardrone_vslam::test {

/// A grey image that owns its pixels. Rows are followed by `padding` bytes that change from row to
/// row: whoever reads them gets a wrong result.
class GreyImage {
 public:
  GreyImage(int width_px, int height_px, int padding = 0, std::uint8_t value = 0)
      : width_(width_px), height_(height_px), stride_(width_px + padding) {
    pixels_.assign(static_cast<std::size_t>(stride_ * height_px), value);
    for (int y = 0; y < height_; ++y) {
      for (int x = width_; x < stride_; ++x)
        at(x, y) = static_cast<std::uint8_t>(y % 2 == 0 ? 255 : 0);
    }
  }

  std::uint8_t& at(int x_px, int y_px) {
    return pixels_[static_cast<std::size_t>(y_px * stride_ + x_px)];
  }
  int at(int x_px, int y_px) const {
    return pixels_[static_cast<std::size_t>(y_px * stride_ + x_px)];
  }
  int width() const { return width_; }
  int height() const { return height_; }
  ImageView view() const { return {pixels_.data(), width_, height_, stride_}; }

 private:
  int width_, height_, stride_;
  std::vector<std::uint8_t> pixels_;
};

inline int uniformInt(std::mt19937& random, int low, int high) {
  // std::uniform_int_distribution differs between standard libraries.
  return low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1));
}

/// Blocks of block_px x block_px pixels of random grey out of `levels` equidistant ones within
/// centre +- contrast / 2, plus noise of +- noise grey levels. 1 px blocks of 256 levels: white
/// noise; few levels: plateaus.
struct BlockTexture {
  int block_px = 4;
  int levels = 256;
  int contrast = 255;
  int noise = 0;
  int centre = 127;
};

/// Fills the columns x_begin .. x_end - 1.
inline void fillBlocks(GreyImage& image, const BlockTexture& texture, std::mt19937& random,
                       int x_begin, int x_end) {
  std::vector<int> line(static_cast<std::size_t>((x_end - x_begin) / texture.block_px + 1));
  for (int y = 0; y < image.height(); ++y) {
    if (y % texture.block_px == 0) {
      for (int& level : line) level = uniformInt(random, 0, texture.levels - 1);
    }
    for (int x = x_begin; x < x_end; ++x) {
      const int level = line[static_cast<std::size_t>((x - x_begin) / texture.block_px)];
      const int grey = texture.centre - texture.contrast / 2 +
                       level * texture.contrast / (texture.levels - 1) +
                       uniformInt(random, -texture.noise, texture.noise);
      image.at(x, y) = static_cast<std::uint8_t>(grey < 0 ? 0 : grey > 255 ? 255 : grey);
    }
  }
}

inline void fillBlocks(GreyImage& image, const BlockTexture& texture, std::mt19937& random) {
  fillBlocks(image, texture, random, 0, image.width());
}

/// Square dots of 1 to 4 px, brighter or darker than the background, one somewhere in each cell_px
/// x cell_px px: FAST-12 corners of known number (a right-angled corner of a large area has only 11
/// pixels in a row on the outside).
struct DotTexture {
  int cell_px = 10;
  int contrast = 100;  ///< of the strongest dots; the weakest have half of it
  int noise = 1;
  int background = 127;
};

/// Fills the columns x_begin .. x_end - 1.
inline void fillDots(GreyImage& image, const DotTexture& texture, std::mt19937& random, int x_begin,
                     int x_end) {
  fillBlocks(image, {1, 2, 0, texture.noise, texture.background}, random, x_begin, x_end);
  const int cell = texture.cell_px;
  for (int top = 0; top + cell <= image.height(); top += cell) {
    for (int left = x_begin; left + cell <= x_end; left += cell) {
      const int side = uniformInt(random, 1, 4);
      const int x0 = left + uniformInt(random, 0, cell - side);
      const int y0 = top + uniformInt(random, 0, cell - side);
      const int strength = uniformInt(random, texture.contrast / 2, texture.contrast);
      const int grey = texture.background + (uniformInt(random, 0, 1) == 0 ? strength : -strength);
      for (int y = y0; y < y0 + side; ++y) {
        for (int x = x0; x < x0 + side; ++x) image.at(x, y) = static_cast<std::uint8_t>(grey);
      }
    }
  }
}

/// Fixed seeds and a new one at each run; use SCOPED_TRACE so that a failure names it.
inline std::vector<unsigned> testSeeds() {
  return {1U, 2U, 3U, std::random_device{}()};
}

/// Images with odd sizes, padding and very different structure, for one seed.
inline std::vector<GreyImage> variedImages(unsigned seed) {
  std::mt19937 random(seed);
  std::vector<GreyImage> images;
  const BlockTexture textures[] = {{1, 256, 255, 0, 127}, {1, 2, 160, 0, 127}, {2, 3, 200, 0, 127},
                                   {3, 256, 255, 4, 127}, {4, 2, 100, 0, 127}, {5, 3, 120, 1, 127},
                                   {7, 4, 255, 2, 127},   {9, 256, 90, 6, 127}};
  for (const BlockTexture& texture : textures) {
    GreyImage image(uniformInt(random, 7, 90), uniformInt(random, 7, 60),
                    uniformInt(random, 0, 19));
    fillBlocks(image, texture, random);
    images.push_back(image);
  }
  for (const DotTexture& texture : {DotTexture{7, 100, 0, 120}, DotTexture{9, 120, 2, 127}}) {
    GreyImage image(uniformInt(random, 30, 90), uniformInt(random, 30, 60),
                    uniformInt(random, 0, 19));
    fillDots(image, texture, random, 0, image.width());
    images.push_back(image);
  }
  return images;
}

/// Images of one size: noise, few grey levels, one grey level, only 0 and 255, dots.
inline std::vector<GreyImage> imagesOfSize(int width_px, int height_px, std::mt19937& random) {
  const int padding = uniformInt(random, 0, 70);
  std::vector<GreyImage> images(6, GreyImage(width_px, height_px, padding, 77));
  fillBlocks(images[1], {1, 256, 255, 0}, random);
  fillBlocks(images[2], {2, 3, 200, 0}, random);
  fillBlocks(images[3], {1, 2, 255, 0}, random);
  fillBlocks(images[4], {3, 2, 255, 3}, random);
  fillDots(images[5], {9, 120, 2}, random, 0, width_px);
  return images;
}

}  // namespace ardrone_vslam::test
