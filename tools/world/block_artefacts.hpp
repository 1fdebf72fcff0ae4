// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>

namespace ardrone_vslam {

/// What H.264's baseline profile leaves of a key frame: each block of 4x4 pixels is predicted by
/// the mean of its decoded neighbours above and to the left, and the transform of the rest is
/// rounded to steps that double with every 6 of `quantiser` (QP, 1 .. 51). No deblocking, no
/// prediction from earlier frames.
/// @param image  8-bit grey; rows and columns beyond a whole number of blocks stay as they are
void addBlockArtefacts(int quantiser, cv::Mat& image);

}  // namespace ardrone_vslam
