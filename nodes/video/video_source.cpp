// SPDX-License-Identifier: BSD-3-Clause
#include "video/video_source.hpp"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <filesystem>
#include <stdexcept>

namespace ardrone_vslam {
namespace {

bool isNumber(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(),
                                      [](unsigned char c) { return std::isdigit(c) != 0; });
}

std::string faultOf(const std::string& device, const std::string& fault) {
  return "device '" + device + "': " + fault;
}

}  // namespace

std::int64_t ageOfImage_ns(double taken_ms, double now_ms) {
  constexpr double kOldest_ms = 1000;  // more than any driver keeps images
  const double age_ms = now_ms - taken_ms;
  const bool is_plausible = taken_ms > 0 && age_ms >= 0 && age_ms <= kOldest_ms;
  return is_plausible ? static_cast<std::int64_t>(age_ms * 1e6) : 0;
}

VideoSource::VideoSource(const std::string& device, const cv::Size& size, double rate_hz)
    : rate_hz_(rate_hz) {
  const std::string path = isNumber(device) ? "/dev/video" + device : device;
  if (path.find("://") != std::string::npos) {
    if (!capture_.open(path, cv::CAP_FFMPEG))
      throw std::runtime_error(
          faultOf(device, "no video comes from this address; check it, and that its server runs"));
    return;
  }
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status))
    throw std::runtime_error(
        faultOf(path,
                "is not there; `ls /dev/video*` shows this computer's cameras, a file needs its "
                "full path"));
  is_file_ = std::filesystem::is_regular_file(status);
  if (!is_file_) {
    openCamera(path, size);
    return;
  }
  if (!capture_.open(path, cv::CAP_FFMPEG))
    throw std::runtime_error(faultOf(device, "is no video that OpenCV can read (by FFmpeg)"));
  constexpr double kFastest_hz = 1000;  // above: the tick of a file that has no rate of its own
  const double own_hz = capture_.get(cv::CAP_PROP_FPS);
  if (own_hz > 0 && own_hz <= kFastest_hz) rate_hz_ = own_hz;
}

void VideoSource::openCamera(const std::string& path, const cv::Size& size) {
  if (!capture_.open(path, cv::CAP_V4L2))
    throw std::runtime_error(
        faultOf(path,
                "is no camera that can be opened; does another program use it, and may this user "
                "(group video)? Cameras often have a second device, for other data: try the next"));
  if (!size.empty()) {
    capture_.set(cv::CAP_PROP_FRAME_WIDTH, size.width);
    capture_.set(cv::CAP_PROP_FRAME_HEIGHT, size.height);
  }
  capture_.set(cv::CAP_PROP_FPS, rate_hz_);
}

bool VideoSource::read(cv::Mat& image, ros::Time& stamp) {
  if (!capture_.read(image) || image.empty()) return false;
  if (is_file_) {
    stamp = due();
    return true;
  }
  const std::chrono::duration<double, std::milli> now =
      std::chrono::steady_clock::now().time_since_epoch();
  ros::Duration age;
  age.fromNSec(ageOfImage_ns(capture_.get(cv::CAP_PROP_POS_MSEC), now.count()));
  stamp = ros::Time::now() - age;
  return true;
}

ros::Time VideoSource::due() {
  if (frames_ == 0) began_ = ros::Time::now();
  const ros::Time stamp = began_ + ros::Duration(frames_++ / rate_hz_);
  ros::Time::sleepUntil(stamp);
  return stamp;
}

}  // namespace ardrone_vslam
