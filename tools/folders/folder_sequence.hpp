// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sequences/sequence.hpp"

namespace ardrone_vslam {

/// What the files of a folder say; the KITTI and the TUM-like layout differ only in how it is read.
struct FolderContents {
  std::string name;
  std::vector<std::string> image_paths;
  std::vector<std::int64_t> stamps_ns;  ///< one for each image, strictly ascending
  CameraIntrinsics camera;
  std::string calibration_path;  ///< for messages
  Eigen::Isometry3d T_base_cam = Eigen::Isometry3d::Identity();
  Trajectory truth;
  std::vector<OdometryState> odometry;
  std::vector<RangeReading> ranges;
};

/// A folder of image files; images may be asked for in any order.
class FolderSequence : public Sequence {
 public:
  explicit FolderSequence(FolderContents contents);

  std::string name() const override { return contents_.name; }
  std::size_t size() const override { return contents_.stamps_ns.size(); }
  std::int64_t stamp_ns(std::size_t index) const override { return contents_.stamps_ns.at(index); }
  cv::Mat image(std::size_t index) override;
  const CameraIntrinsics& camera() const override { return contents_.camera; }
  Eigen::Isometry3d T_base_cam() const override { return contents_.T_base_cam; }
  const Trajectory& truth() const override { return contents_.truth; }
  const std::vector<OdometryState>& odometry() const override { return contents_.odometry; }
  std::vector<RangeReading> ranges() const override { return contents_.ranges; }

 private:
  FolderContents contents_;
};

/// 8-bit grey. @throws std::runtime_error naming the file when it cannot be decoded
cv::Mat readGreyImage(const std::string& path);

/// @throws std::runtime_error naming image and calibration when their sizes differ
void checkImageSize(const cv::Mat& image, const std::string& image_name,
                    const CameraIntrinsics& camera, const std::string& calibration_name);

}  // namespace ardrone_vslam
