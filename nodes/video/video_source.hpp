// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/time.h>

#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/videoio.hpp>
#include <string>

namespace ardrone_vslam {

/// Since the driver took an image. @param taken_ms,now_ms  on the computer's monotonic clock
/// @return 0 where `taken_ms` is no such time: OpenCV has none, or the driver's clock is another
std::int64_t ageOfImage_ns(double taken_ms, double now_ms);

/// A camera of this computer, a stream of the network, or a video file, through OpenCV. Stamps are
/// of the computer's time of day.
class VideoSource {
 public:
  /// @param device  /dev/videoN or N; an address with "://"; or a video file
  /// @param size  asked of a camera, which may give another; empty: as it likes
  /// @param rate_hz  likewise; also of a file that has none of its own
  /// @throws std::runtime_error with the device, what is wrong and what to do
  VideoSource(const std::string& device, const cv::Size& size, double rate_hz);

  bool isFile() const { return is_file_; }

  /// Waits for the next image: a camera gives it in time, one of a file comes at the file's rate.
  /// @param image  bgr. @param stamp  when it was taken, as far as the driver tells
  /// @return false at a file's end, or when the camera is gone
  bool read(cv::Mat& image, ros::Time& stamp);

 private:
  void openCamera(const std::string& path, const cv::Size& size);
  /// Of a file's next image, for which it waits.
  ros::Time due();

  cv::VideoCapture capture_;
  bool is_file_ = false;
  double rate_hz_ = 0;
  ros::Time began_;  ///< the stamp of a file's first image
  int frames_ = 0;   ///< of a file, so far
};

}  // namespace ardrone_vslam
