// SPDX-License-Identifier: BSD-3-Clause
#include "bags/messages/bag_file.hpp"

#include <filesystem>
#include <memory>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

namespace ardrone_vslam {

namespace {

/// rosbag's destructor writes the index, and ends the program when that fails: a bag that could not
/// be written is never destroyed. Its file's blocks are free again.
void abandon(std::unique_ptr<rosbag::Bag> bag, const std::string& path) {
  static auto* const abandoned = new std::vector<std::unique_ptr<rosbag::Bag>>();
  abandoned->push_back(std::move(bag));
  std::error_code ignored;
  std::filesystem::resize_file(path, 0, ignored);
  std::filesystem::remove(path, ignored);
}

}  // namespace

void writeBagFile(const std::string& path, BagCompression compression,
                  const std::function<void(rosbag::Bag&)>& write) {
  // An interrupted run must not leave half a bag under the name of a whole one.
  const std::string part = path + ".part";
  auto bag = std::make_unique<rosbag::Bag>();
  try {
    bag->open(part, rosbag::bagmode::Write);
    if (compression == BagCompression::kLz4) {
      bag->setCompression(rosbag::compression::LZ4);
    } else if (compression == BagCompression::kBz2) {
      bag->setCompression(rosbag::compression::BZ2);
    }
    write(*bag);
    bag->close();
    std::filesystem::rename(part, path);
  } catch (const rosbag::BagException& e) {
    abandon(std::move(bag), part);
    throw std::runtime_error(path + ": cannot be written (" + e.what() +
                             "); check the folder, its permissions and the free space");
  } catch (...) {
    abandon(std::move(bag), part);
    throw;
  }
}

sensor_msgs::CompressedImage compressedImage(const std_msgs::Header& header, const cv::Mat& image,
                                             bool is_png) {
  constexpr int kJpegQuality = 90;
  const bool is_colour = image.channels() == 3;
  cv::Mat pixels = image;
  if (is_colour) cv::cvtColor(image, pixels, cv::COLOR_RGB2BGR);
  sensor_msgs::CompressedImage message;
  message.header = header;
  message.format = std::string(is_colour ? "rgb8" : "mono8") + "; " + (is_png ? "png" : "jpeg") +
                   " compressed " + (is_colour ? "bgr8" : "");
  const std::vector<int> quality{cv::IMWRITE_JPEG_QUALITY, kJpegQuality};
  cv::imencode(is_png ? ".png" : ".jpg", pixels, message.data,
               is_png ? std::vector<int>() : quality);
  return message;
}

}  // namespace ardrone_vslam
