// SPDX-License-Identifier: BSD-3-Clause
#include "alignment/patch.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace ardrone_vslam {
namespace {

using kernels::AlignPatch;
using kernels::kPatchBorder;
using kernels::kPatchPixels;
using kernels::kPatchSide;

/// Sums over the compared pixels' gradients along x and y, and levels: whole numbers, so that they
/// are the same on every machine.
struct PatchSums {
  Eigen::Vector3i sum = Eigen::Vector3i::Zero();
  Eigen::Matrix3i products = Eigen::Matrix3i::Zero();
};

using Column = std::int16_t[kPatchSide * kPatchSide];

int sumOf(const Column& column) {
  int sum = 0;
  for (const std::int16_t value : column) sum += value;
  return sum;
}

int productOf(const Column& a, const Column& b) {
  int sum = 0;
  for (int i = 0; i < kPatchSide * kPatchSide; ++i) sum += int{a[i]} * int{b[i]};
  return sum;
}

// Columns of 16 bits: of these a compiler makes vectors.
PatchSums sumsOf(const AlignPatch& patch) {
  alignas(16) Column columns[3];
  for (int row = 0; row < kPatchSide; ++row) {
    for (int column = 0; column < kPatchSide; ++column) {
      const int i = row * kPatchSide + column;
      const int y = row + kPatchBorder;
      const int x = column + kPatchBorder;
      columns[0][i] = static_cast<std::int16_t>(patch.rows[y][x + 1] - patch.rows[y][x - 1]);
      columns[1][i] = static_cast<std::int16_t>(patch.rows[y + 1][x] - patch.rows[y - 1][x]);
      columns[2][i] = patch.rows[y][x];
    }
  }
  PatchSums sums;
  for (int a = 0; a < 3; ++a) {
    sums.sum[a] = sumOf(columns[a]);
    for (int b = a; b < 3; ++b)
      sums.products(a, b) = sums.products(b, a) = productOf(columns[a], columns[b]);
  }
  return sums;
}

/// A place in the surroundings, and what it moves by from column to column or row to row.
struct Place {
  static constexpr int kBits = 16;  // behind the point
  std::int32_t x;
  std::int32_t y;

  explicit Place(const std::complex<float>& px) : x(fixed(px.real())), y(fixed(px.imag())) {}
  void operator+=(const Place& step) {
    x += step.x;
    y += step.y;
  }

 private:
  static std::int32_t fixed(float px) {
    return static_cast<std::int32_t>(std::lround(px * (1 << kBits)));
  }
};

/// Between four pixels, at steps of 1/128 px.
std::uint8_t levelAt(const Surroundings& surroundings, const Place& at) {
  constexpr int kLevelBits = 7;
  constexpr int kSteps = 1 << kLevelBits;
  const auto fraction = [](std::int32_t px) {
    return px >> (Place::kBits - kLevelBits) & (kSteps - 1);
  };
  const std::int32_t right = fraction(at.x);
  const std::uint8_t* above = &surroundings.rows[at.y >> Place::kBits][at.x >> Place::kBits];
  const auto between = [right](const std::uint8_t* row) {
    return row[0] * kSteps + (row[1] - row[0]) * right;
  };
  const std::int32_t first = between(above);
  const std::int32_t second = between(above + Surroundings::kSide);
  constexpr std::int32_t kHalf = kSteps * kSteps / 2;
  return static_cast<std::uint8_t>((first * kSteps + (second - first) * fraction(at.y) + kHalf) >>
                                   (2 * kLevelBits));
}

/// Fills in what follows from the levels.
std::optional<AlignPatch> prepared(AlignPatch patch) {
  const PatchSums sums = sumsOf(patch);
  const Eigen::Vector3d mean = sums.sum.cast<double>() / kPatchPixels;
  const Eigen::Matrix3d products =
      sums.products.cast<double>() - mean * sums.sum.cast<double>().transpose();
  // Gradients as weak as the steps of grey levels tell no place.
  constexpr double kLeastGradient2 = kPatchPixels;
  const double least = products(0, 0) + products(1, 1) -
                       Eigen::Vector2d(products(0, 0) - products(1, 1), 2 * products(0, 1)).norm();
  if (!(least > kLeastGradient2)) return std::nullopt;
  const Eigen::Matrix3f inverse = products.inverse().cast<float>();
  if (!inverse.allFinite() || !(inverse.diagonal().minCoeff() > 0)) return std::nullopt;
  Eigen::Map<Eigen::Vector3f>(patch.mean) = mean.cast<float>();
  int place = 0;
  for (int row = 0; row < 3; ++row)
    for (int column = row; column < 3; ++column) patch.inverse[place++] = inverse(row, column);
  return patch;
}

/// Inverse of the structure without what is there along an edge, too, where nothing tells the
/// place: the gradients of noise, and those of an edge that is sampled.
/// @param noise  what noise alone gives in each direction
/// @param least  what is left at least
Eigen::Matrix2f trustedInverse(const Eigen::Matrix2f& structure, float noise, float least) {
  constexpr float kSampled = 0.05F;  // of the structure across an edge
  const Eigen::Vector2f spread(structure(0, 0) - structure(1, 1), 2 * structure(0, 1));
  const float half = spread.norm() / 2;
  const float middle = structure.trace() / 2 - noise;
  const float large = std::max(middle + half, least);
  const float small = std::max(middle - half - kSampled * large, least);
  // Of the same directions as the structure, with the inverse of both.
  const float mean = (1 / large + 1 / small) / 2;
  const Eigen::Vector2f difference = (1 / large - 1 / small) / 2 * spread.normalized();
  Eigen::Matrix2f inverse;
  inverse << mean + difference.x(), difference.y(), difference.y(), mean - difference.x();
  return inverse;
}

}  // namespace

Surroundings surroundingsOf(const ImageView& image, int x_px, int y_px) {
  constexpr int kBefore = Surroundings::kCentre;
  assert(x_px >= kBefore && x_px <= image.width_px - kBefore && y_px >= kBefore &&
         y_px <= image.height_px - kBefore && "too near to the image's border");
  Surroundings surroundings;
  for (int row = 0; row < Surroundings::kSide; ++row)
    std::memcpy(surroundings.rows[row], image.row(y_px + row - kBefore) + x_px - kBefore,
                Surroundings::kSide);
  return surroundings;
}

std::optional<AlignPatch> patchOf(const Surroundings& surroundings, const ViewChange& change) {
  assert(std::sqrt(squareOf(change)) >= Surroundings::kLeastGrowth &&
         "the surroundings do not reach so far");
  constexpr auto kFirst = static_cast<float>(-kernels::kPatchCentre);
  constexpr auto kCentre = static_cast<float>(Surroundings::kCentre);
  const ViewChange back = quotientOf(kSameView, change);
  const Place column_step(back);
  const Place row_step(back * ViewChange(0, 1));
  Place row_begin(back * ViewChange(kFirst, kFirst) + ViewChange(kCentre, kCentre));
  AlignPatch patch{};
  for (auto& row : patch.rows) {
    Place at = row_begin;
    for (int column = 0; column < kernels::kPatchRows; ++column, at += column_step)
      row[column] = levelAt(surroundings, at);
    row_begin += row_step;
  }
  return prepared(patch);
}

Eigen::Matrix2f positionVariance_px2(const AlignPatch& patch, const kernels::AlignResult& found) {
  constexpr float kFreedom = kPatchPixels - 4;  // shift, gain and offset are taken out
  const float level2 = std::max(found.rest, 0.F) / (kFreedom * found.gain * found.gain);
  // Three quarters of what is left are the patch's own noise: the image's is smoothed between
  // pixels. A gradient is a difference of two levels, hence twice.
  constexpr float kNoise = 2 * kPatchPixels * 0.75F;
  // Along an edge the match of corners still tells so much.
  constexpr float kMost_px2 = 0.8F * 0.8F;
  const float unit = 4 * std::max(level2, 1e-6F);
  Eigen::Matrix2f inverse;
  inverse << patch.inverse[0], patch.inverse[1], patch.inverse[1], patch.inverse[3];
  return unit * trustedInverse(inverse.inverse(), kNoise * level2, unit / kMost_px2);
}

float explainedShare(const kernels::AlignResult& found) {
  return 1 - std::max(found.rest, 0.F) / found.contrast;
}

}  // namespace ardrone_vslam
