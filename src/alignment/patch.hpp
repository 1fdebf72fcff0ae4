// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

#include "ardrone_vslam/image_view.hpp"
#include "kernels/align/align_kernels.hpp"

namespace ardrone_vslam {

/// The patch around a pixel, at least kPatchStride inside the image (asserted).
/// @return nothing where there is no structure to align
std::optional<kernels::AlignPatch> patchOf(const ImageView& image, int x_px, int y_px);

/// How well an alignment tells the position, by the patch's structure and what the alignment left.
/// @return variance [px^2], columns and rows
Eigen::Matrix2f positionVariance_px2(const kernels::AlignPatch& patch,
                                     const kernels::AlignResult& found);

/// Share of the image's contrast that the patch explains, at most 1.
float explainedShare(const kernels::AlignResult& found);

}  // namespace ardrone_vslam
