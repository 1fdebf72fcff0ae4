// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace ardrone_vslam {

/// A detected corner. Pixel centres have integer coordinates, (0, 0) is the top left one.
struct Corner {
  std::int16_t x_px = 0;   ///< column
  std::int16_t y_px = 0;   ///< row
  std::uint8_t score = 0;  ///< largest threshold at which the pixel is still a corner, 0..254
};

/// The 512 bits of a binary descriptor; `words` read as bytes in memory order (little endian) are
/// OpenCV contrib's FREAK bytes.
struct DescriptorBits {
  std::array<std::uint64_t, 8> words{};  ///< bits 0..63 in the first

  /// Whether all 512 bits are the same.
  bool operator==(const DescriptorBits& other) const { return words == other.words; }
  /// Whether any bit differs.
  bool operator!=(const DescriptorBits& other) const { return words != other.words; }
};
/// A descriptor that has a cache line to itself, as fits arrays that are searched.
struct alignas(64) Descriptor : DescriptorBits {
  Descriptor() = default;  ///< zero
  /// Explicit: it is a copy.
  explicit Descriptor(const DescriptorBits& bits) : DescriptorBits(bits) {}
};
static_assert(sizeof(Descriptor) == 64, "a descriptor is exactly 512 bits");

/// What is known of a feature's position beside its track's first corner: the inverse of the
/// variance along columns and rows. All 0: not aligned, the position is a corner's whole pixel.
struct PixelInformation {
  float xx_per_px2 = 0;  ///< along columns
  float xy_per_px2 = 0;  ///< of both
  float yy_per_px2 = 0;  ///< along rows

  /// Whether it tells nothing.
  bool empty() const { return xx_per_px2 == 0 && yy_per_px2 == 0; }
};

constexpr std::uint32_t kNoTrack = 0;  ///< a track id that no feature of a tracker has

/// All features of one image: arrays of equal length, entry i of each belongs to feature i.
struct ImageFeatures {
  std::int64_t stamp_ns = 0;  ///< the image's time stamp
  int width_px = 0;           ///< of the image
  int height_px = 0;          ///< of the image
  float focal_length_px =
      0.F;  ///< geometric mean of fx and fy; one pixel is 1 / focal_length_px rad

  std::vector<Eigen::Vector2f>
      pixel_px;  ///< as seen (distorted), column and row: between pixels where it is aligned
  std::vector<Eigen::Vector3f>
      bearing_cam;  ///< unit vectors in the optical frame (x right, y down, z forward)
  std::vector<std::uint8_t> score;  ///< corner score, Corner::score
  std::vector<std::uint32_t>
      track_id;  ///< stable from frame to frame; never 0, never used again in one run
  std::vector<std::uint16_t> age_frames;  ///< frames since the track began, 0 for a new one
  std::vector<Descriptor> descriptor;     ///< FREAK of the patch around the corner
  // Of a tracker that aligns; else both are empty.
  std::vector<PixelInformation> information;  ///< of the position
  std::vector<float> residual;  ///< root mean square that alignment left [grey levels]

  /// Number of features.
  std::size_t size() const { return pixel_px.size(); }
  /// How many of them carry on a track.
  std::size_t tracked() const;
  /// How many of these are aligned: the others are where their corner is.
  std::size_t aligned() const;
  /// No features; the arrays keep their memory.
  void clear();
  /// Makes room for so many features in every array.
  void reserve(std::size_t count);
};

}  // namespace ardrone_vslam
