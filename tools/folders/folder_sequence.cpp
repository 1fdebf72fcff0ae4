// SPDX-License-Identifier: BSD-3-Clause
#include "folders/folder_sequence.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "files/regular_file.hpp"
#include "folders/kitti_folder.hpp"
#include "folders/tum_folder.hpp"
#include "input_checks/decode_image.hpp"

namespace ardrone_vslam {

cv::Mat readGreyImage(const std::string& path) {
  requireFile(path, kLargestImage_bytes);
  std::ifstream file(path, std::ios::binary);
  const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(file), {}};
  cv::Mat image = decodeGrey(bytes);
  if (image.empty()) {
    throw std::runtime_error(path +
                             ": cannot be decoded as an image; replace the file (truncated, or not "
                             "png, jpg or pgm)");
  }
  return image;
}

void checkImageSize(const cv::Mat& image, const std::string& image_name,
                    const CameraIntrinsics& camera, const std::string& calibration_name) {
  if (image.cols == camera.width_px && image.rows == camera.height_px) return;
  const auto size = [](int width_px, int height_px) {
    return std::to_string(width_px) + "x" + std::to_string(height_px);
  };
  throw std::runtime_error(image_name + ": is " + size(image.cols, image.rows) + " but " +
                           calibration_name + " is for " + size(camera.width_px, camera.height_px) +
                           "; use the calibration made at the size of the images");
}

FolderSequence::FolderSequence(FolderContents contents) : contents_(std::move(contents)) {}

cv::Mat FolderSequence::image(std::size_t index) {
  const std::string& path = contents_.image_paths.at(index);
  cv::Mat image = readGreyImage(path);
  checkImageSize(image, path, contents_.camera, contents_.calibration_path);
  return image;
}

std::unique_ptr<Sequence> openFolder(const std::string& path) {
  if (!std::filesystem::exists(path)) {
    throw std::runtime_error(path + ": there is no such folder; check the path");
  }
  if (!std::filesystem::is_directory(path)) {
    throw std::runtime_error(path + ": is a file, not a KITTI or TUM-like folder");
  }
  if (isKittiFolder(path)) return openKittiFolder(path);
  if (isTumFolder(path)) return openTumFolder(path);
  throw std::runtime_error(path +
                           ": is neither a KITTI folder (image_0/, calib.txt, times.txt) nor a "
                           "TUM-like one (image/, camera.yaml, times.txt); give the folder that "
                           "holds image_0/ or image/");
}

}  // namespace ardrone_vslam
