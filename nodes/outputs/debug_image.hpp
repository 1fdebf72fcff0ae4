// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>

#include "ardrone_vslam/features.hpp"

namespace ardrone_vslam {

/// The grey image in colour with a circle around each feature: blue for a new one, over green to
/// red for a track of ten images or more.
cv::Mat drawFeatures(const cv::Mat& grey, const ImageFeatures& features);

}  // namespace ardrone_vslam
