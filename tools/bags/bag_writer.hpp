// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "bags/messages/bag_file.hpp"
#include "sequences/sequence.hpp"
#include "simulation/odometry_model.hpp"

namespace ardrone_vslam {

struct BagTopicNames {
  std::string image = "/camera/image_raw";  ///< compressed images go to image + "/compressed"
  std::string camera_info = "/camera/camera_info";
  std::string odometry = "/odometry";
  std::string truth = "/truth/pose";
  std::string range = "/range";  ///< when the sequence has ranges
  std::string info = "/make_bag/info";
};

struct BagFrameNames {
  std::string map = "map";
  std::string odom = "odom";
  std::string base = "base_link";
  std::string camera = "camera_optical";
};

struct BagWriteOptions {
  enum class ImageFormat { kRaw, kPng, kJpeg };
  using Compression = BagCompression;

  BagTopicNames topics;
  BagFrameNames frames;
  ImageFormat image_format = ImageFormat::kRaw;
  Compression compression = Compression::kNone;  ///< of the bag's chunks
  /// Corrupts the truth to odometry; nothing: the sequence's own odometry, if it has one.
  std::optional<OdometryProfile> odometry_profile;
  std::uint64_t seed = 0;
  std::string tool;  ///< name and version of the program, for the info topic
  std::function<void(std::size_t done, std::size_t total)> progress;  ///< images; may be empty
};

struct BagWriteReport {
  std::size_t images = 0;
  std::size_t odometry = 0;
  std::size_t truth = 0;
  double scale_error = 0;            ///< drawn by the odometry's profile
  std::int64_t stamp_offset_ns = 0;  ///< added to all stamps, as ROS has no time 0
};

/// Writes the sequence as a bag: image (mono8), camera_info, odometry (twist by differences, in
/// base) with tf odom -> base, ranges, latched tf_static base -> camera (a second camera has a
/// frame of its own, CAMERA_2), the truth (PoseStamped in map) and a latched std_msgs/String of
/// YAML that says how the bag was made. Messages come in the order of time, recorded at their
/// stamps. Equal arguments give equal bytes. When it fails nothing is left behind and an existing
/// file stays.
/// @throws std::runtime_error naming file or sequence, fault and remedy; a profile without truth
BagWriteReport writeBag(Sequence& sequence, const BagWriteOptions& options,
                        const std::string& path);

}  // namespace ardrone_vslam
