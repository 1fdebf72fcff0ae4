// SPDX-License-Identifier: BSD-3-Clause
#include "picture_changes.hpp"

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace ardrone_vslam::quality {
namespace {

cv::Mat insideMask(const cv::Size& size) {
  const int border = static_cast<int>(kBorder_px);
  cv::Mat mask(size, CV_8UC1, cv::Scalar(0));
  const cv::Rect inside(border, border, size.width - 2 * border, size.height - 2 * border);
  if (inside.width > 0 && inside.height > 0) mask(inside).setTo(255);
  return mask;
}

}  // namespace

ChangedPicture unchanged(const cv::Mat& picture) {
  return {{picture, insideMask(picture.size()), 0}, Eigen::Matrix3d::Identity()};
}

ChangedPicture turned(const cv::Mat& picture, double angle_deg) {
  // By an even number larger, so that the picture's pixels stay whole at 0 and 180 degrees.
  const double diagonal = std::hypot(picture.cols, picture.rows);
  const cv::Size canvas(
      picture.cols + 2 * static_cast<int>(std::ceil((diagonal - picture.cols) / 2)),
      picture.rows + 2 * static_cast<int>(std::ceil((diagonal - picture.rows) / 2)));
  const double angle_rad = angle_deg * M_PI / 180;
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  const Eigen::Vector2d from((picture.cols - 1) / 2.0, (picture.rows - 1) / 2.0);
  const Eigen::Vector2d to((canvas.width - 1) / 2.0, (canvas.height - 1) / 2.0);
  Eigen::Matrix3d H = Eigen::Matrix3d::Identity();
  H.topLeftCorner<2, 2>() << c, -s, s, c;
  H.topRightCorner<2, 1>() = to - H.topLeftCorner<2, 2>() * from;

  const cv::Matx23d M(H(0, 0), H(0, 1), H(0, 2), H(1, 0), H(1, 1), H(1, 2));
  ChangedPicture result;
  result.H_changed_picture = H;
  result.view.rotation_rad = angle_rad;
  cv::warpAffine(picture, result.view.image, M, canvas, cv::INTER_CUBIC, cv::BORDER_REFLECT_101);
  cv::warpAffine(insideMask(picture.size()), result.view.mask, M, canvas, cv::INTER_NEAREST);
  return result;
}

ChangedPicture scaled(const cv::Mat& picture, double factor) {
  const cv::Size size(static_cast<int>(std::lround(picture.cols * factor)),
                      static_cast<int>(std::lround(picture.rows * factor)));
  ChangedPicture result;
  cv::resize(picture, result.view.image, size, 0, 0, factor < 1 ? cv::INTER_AREA : cv::INTER_CUBIC);
  result.view.mask = insideMask(size);
  // cv::resize keeps the outer borders of the border pixels where they are.
  const double x = static_cast<double>(size.width) / picture.cols;
  const double y = static_cast<double>(size.height) / picture.rows;
  result.H_changed_picture << x, 0, (x - 1) / 2, 0, y, (y - 1) / 2, 0, 0, 1;
  return result;
}

ChangedPicture blurred(const cv::Mat& picture, double sigma_px) {
  ChangedPicture result = unchanged(picture);
  if (sigma_px > 0) {
    result.view.image = cv::Mat();  // not in place: it shares the picture's pixels
    cv::GaussianBlur(picture, result.view.image, cv::Size(), sigma_px);
  }
  return result;
}

}  // namespace ardrone_vslam::quality
