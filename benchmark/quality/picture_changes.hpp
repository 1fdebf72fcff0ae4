// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "feature_methods.hpp"

namespace ardrone_vslam::quality {

/// A picture after a change, and where its pixels went. The mask spares kBorder_px inside the
/// picture's own border.
struct ChangedPicture {
  View view;
  Eigen::Matrix3d H_changed_picture;
};

/// The picture as it is.
ChangedPicture unchanged(const cv::Mat& picture);

/// Turned clockwise as seen, on a canvas that holds it at every angle.
ChangedPicture turned(const cv::Mat& picture, double angle_deg);

/// Enlarged (cubic) or reduced (area) by the factor.
ChangedPicture scaled(const cv::Mat& picture, double factor);

/// Gaussian blur. @param sigma_px  0: none
ChangedPicture blurred(const cv::Mat& picture, double sigma_px);

}  // namespace ardrone_vslam::quality
