// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace ardrone_vslam {

/// Whether a JPEG lacks its end-of-image marker or a PNG its last chunk; whatever follows these
/// (padding) does no harm. OpenCV decodes such a JPEG all the same, the missing part as flat grey.
bool isCutOff(const std::vector<std::uint8_t>& encoded);

/// JPEG, PNG or whatever else OpenCV decodes, as 8-bit grey.
/// @return empty when it cannot be decoded, is cut off, or is a PNG whose check sums are wrong.
/// libjpeg's word on a damaged JPEG goes to stderr: such an image is used, and that is all that
/// tells of it. @throws cv::Exception for some faults
cv::Mat decodeGrey(const std::vector<std::uint8_t>& encoded);

}  // namespace ardrone_vslam
