// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "ardrone_vslam/camera_model.hpp"
#include "ardrone_vslam/image_view.hpp"
#include "simulation/random_source.hpp"

namespace ardrone_vslam::test {

/// A flight without end from the images of one way: it is flown forth, then back, and so on. Images
/// are rendered once, without noise; each that is asked for has noise of its own, as what repeats
/// exactly would be taken for new evidence.
class ThereAndBack {
 public:
  static constexpr int kImages_hz = 30;
  static constexpr int kPoses_hz = 200;

  static constexpr double kLap_s = 21.5;  ///< one lap, at rest at both ends

  /// Renders, which takes some seconds a lap, and 2.3 MB a second.
  /// @param way_s  kLap_s, or else so long of laps without a rest, which turn round at once
  /// @param seed  of the noise
  ThereAndBack(double way_s, std::uint64_t seed);

  /// Of the whole flight's images from 0 on; good until the next call.
  ImageView image(std::uint64_t index);
  Eigen::Isometry3d poseAtImage(std::uint64_t index) const {
    return at(T_map_base_of_images_, index);
  }
  /// True poses, kPoses_hz of them a second; the first is the first image's.
  Eigen::Isometry3d T_map_base(std::uint64_t index) const { return at(T_map_base_, index); }

  const CameraIntrinsics& camera() const { return camera_; }
  const Eigen::Isometry3d& T_base_cam() const { return T_base_cam_; }

 private:
  template <class Item>
  static const Item& at(const std::vector<Item>& way, std::uint64_t index) {
    const std::uint64_t last = way.size() - 1;
    const std::uint64_t there = index % (2 * last);
    return way[there <= last ? there : 2 * last - there];
  }

  CameraIntrinsics camera_;
  Eigen::Isometry3d T_base_cam_;
  std::vector<cv::Mat> images_;
  std::vector<Eigen::Isometry3d> T_map_base_of_images_;
  std::vector<Eigen::Isometry3d> T_map_base_;
  RandomSource random_;
  std::vector<std::int8_t> noise_;  // longer than an image: each begins elsewhere
  cv::Mat noisy_;
};

}  // namespace ardrone_vslam::test
