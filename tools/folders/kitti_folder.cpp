// SPDX-License-Identifier: BSD-3-Clause
#include "folders/kitti_folder.hpp"

#include <Eigen/LU>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <utility>

#include "files/regular_file.hpp"
#include "folders/folder_files.hpp"
#include "folders/folder_sequence.hpp"

namespace ardrone_vslam {
namespace {

/// P0 = K [I | 0]; KITTI's images are rectified, so there is no distortion. The size is the first
/// image's, as calib.txt gives none.
CameraIntrinsics readCalibration(const std::string& path, const std::string& first_image) {
  std::ifstream file = openFile(path, kLargestTable_bytes,
                                "the folder needs KITTI's calibration file with its line P0");
  std::string line;
  for (std::size_t line_number = 1; std::getline(file, line); ++line_number) {
    if (line.compare(0, 3, "P0:") != 0) continue;
    const auto p = parseNumbers(line.substr(3), path, line_number);
    if (p.size() != 12) {
      throw std::runtime_error(path + ", line " + std::to_string(line_number) + ": P0 has " +
                               std::to_string(p.size()) + " numbers, it must have 12");
    }
    const cv::Mat image = readGreyImage(first_image);
    CameraIntrinsics camera;
    camera.width_px = image.cols;
    camera.height_px = image.rows;
    camera.fx_px = static_cast<double>(p[0]);
    camera.cx_px = static_cast<double>(p[2]);
    camera.fy_px = static_cast<double>(p[5]);
    camera.cy_px = static_cast<double>(p[6]);
    // KITTI's principal points lie within 5 % of the middle; further off it is another image's
    // calibration.
    constexpr double kFarthestOff = 0.15;
    const bool is_possible = camera.fx_px > 0 && camera.fy_px > 0 &&
                             std::abs(camera.cx_px / image.cols - 0.5) < kFarthestOff &&
                             std::abs(camera.cy_px / image.rows - 0.5) < kFarthestOff;
    if (!is_possible) {
      throw std::runtime_error(
          path +
          ": P0 has no positive focal length with a principal point near the middle of images of " +
          std::to_string(image.cols) + "x" + std::to_string(image.rows) +
          "; use the calibration that belongs to the images");
    }
    return camera;
  }
  throw std::runtime_error(path + ": has no line P0; take calib.txt of the same KITTI sequence");
}

/// @param place  for messages: file and line
Eigen::Isometry3d poseFromRow(const std::vector<long double>& row, const std::string& place) {
  Eigen::Matrix3d rotation;
  Eigen::Vector3d translation;
  for (std::size_t i = 0; i < 12; ++i) {
    const auto r = static_cast<Eigen::Index>(i / 4);
    const auto c = static_cast<Eigen::Index>(i % 4);
    (c < 3 ? rotation(r, c) : translation(r)) = static_cast<double>(row[i]);
  }
  if (!rotation.allFinite() || !translation.allFinite()) {
    throw std::runtime_error(place + "the pose is not finite; correct it");
  }
  if (isTooFar(translation)) throw std::runtime_error(place + kTooFarFault + "; correct it");
  constexpr double kSlack = 1e-3;  // of the file's digits
  const Eigen::Matrix3d excess = rotation.transpose() * rotation - Eigen::Matrix3d::Identity();
  if (!(excess.cwiseAbs().maxCoeff() < kSlack) || !(rotation.determinant() > 0)) {
    throw std::runtime_error(place +
                             "the 3x3 block of the pose is no rotation (orthonormal, determinant "
                             "1); correct it, a KITTI pose is a row of [R | t]");
  }
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  // The file's seven digits make a matrix that is no exact rotation.
  pose.linear() = Eigen::Quaterniond(rotation).normalized().toRotationMatrix();
  pose.translation() = translation;
  return pose;
}

}  // namespace

Trajectory readKittiPoses(const std::string& path, const std::vector<std::int64_t>& stamps_ns) {
  requireFile(path, kLargestTable_bytes);
  std::ifstream file(path);
  if (!file) return {};
  const Eigen::Isometry3d axes(forwardCamera().linear());
  std::vector<StampedPose> poses;
  std::string line;
  for (std::size_t line_number = 1; std::getline(file, line); ++line_number) {
    const auto row = parseNumbers(line, path, line_number);
    if (row.empty()) continue;
    const std::string place = path + ", line " + std::to_string(line_number) + ": ";
    if (row.size() != 12) {
      throw std::runtime_error(place + "has " + std::to_string(row.size()) +
                               " numbers, a KITTI pose has 12");
    }
    const Eigen::Isometry3d T_cam0_cam = poseFromRow(row, place);
    if (poses.size() < stamps_ns.size()) {
      poses.push_back({stamps_ns[poses.size()], axes * T_cam0_cam * axes.inverse()});
    } else {
      throw std::runtime_error(place + "more poses than the " + std::to_string(stamps_ns.size()) +
                               " stamps of times.txt; give one pose for each image");
    }
  }
  if (poses.size() != stamps_ns.size()) {
    throw std::runtime_error(path + ": has " + std::to_string(poses.size()) + " poses for " +
                             std::to_string(stamps_ns.size()) +
                             " stamps of times.txt; give one pose for each image, or no poses.txt");
  }
  return Trajectory(std::move(poses));
}

bool isKittiFolder(const std::string& path) {
  return std::filesystem::is_directory(path + "/image_0");
}

std::unique_ptr<Sequence> openKittiFolder(const std::string& path) {
  FolderContents contents;
  contents.name = path;
  contents.image_paths = listImages(path + "/image_0");
  contents.calibration_path = path + "/calib.txt";
  contents.camera = readCalibration(contents.calibration_path, contents.image_paths.front());
  contents.stamps_ns = readImageStamps(path + "/times.txt", contents.image_paths.size());
  contents.T_base_cam = forwardCamera();
  contents.truth = readKittiPoses(path + "/poses.txt", contents.stamps_ns);
  return std::make_unique<FolderSequence>(std::move(contents));
}

}  // namespace ardrone_vslam
