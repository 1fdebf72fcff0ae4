// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "alignment/view_change.hpp"
#include "ardrone_vslam/image_view.hpp"
#include "kernels/align/align_kernels.hpp"

namespace ardrone_vslam {

/// The grey levels around a pixel: so wide that a patch of them can be turned, and shrunk to
/// kLeastGrowth.
struct Surroundings {
  static constexpr int kSide = 20;
  static constexpr int kCentre = kSide / 2;  ///< column and row of the pixel itself
  static constexpr float kLeastGrowth = 0.8F;

  std::uint8_t rows[kSide][kSide];
};

/// @param x_px, y_px  at least Surroundings::kCentre inside the image (asserted)
Surroundings surroundingsOf(const ImageView& image, int x_px, int y_px);

/// The patch in the middle, as a later view shows it. The levels are sampled in whole numbers.
/// @param change  from the surroundings' image on, of a growth of at least kLeastGrowth (asserted)
/// @return nothing where there is no structure to align
std::optional<kernels::AlignPatch> patchOf(const Surroundings& surroundings,
                                           const ViewChange& change = kSameView);

/// How well an alignment tells the position, by the patch's structure and what the alignment left.
/// @return variance [px^2], columns and rows
Eigen::Matrix2f positionVariance_px2(const kernels::AlignPatch& patch,
                                     const kernels::AlignResult& found);

/// Share of the image's contrast that the patch explains, at most 1.
float explainedShare(const kernels::AlignResult& found);

}  // namespace ardrone_vslam
