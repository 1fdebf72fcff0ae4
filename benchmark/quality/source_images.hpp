// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace ardrone_vslam::quality {

/// An 8-bit grey picture. @throws std::runtime_error naming the file that cannot be read and the
/// remedy
cv::Mat readGrey(const std::string& path);

/// Nine numbers, row by row. @throws std::runtime_error naming the file and the remedy
Eigen::Matrix3d readHomography(const std::string& path);

/// Pictures that the sweeps turn, scale and blur.
struct SourceImages {
  std::vector<cv::Mat> images;
  std::string what;  ///< for the report
};

/// mandrill, peppers and lena of the data folder; without it three views of the synthetic room.
/// @param quick  one of them
SourceImages sweepImages(bool quick);

}  // namespace ardrone_vslam::quality
