// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <vector>

#include "ardrone_vslam/time_offset.hpp"
#include "matching/track_order.hpp"
#include "odometry/image_rotation.hpp"

namespace ardrone_vslam {

/// What TimeOffsetEstimator does and remembers.
class TimeOffsetEstimator::State {
 public:
  State(const Eigen::Isometry3d& T_base_cam, double centre_s);
  void see(const ImageFeatures& features, const OdometryBuffer& odometry);
  const TimeOffset& estimate() const { return estimate_; }
  void useCamera(const Eigen::Isometry3d& T_base_cam);

 private:
  static constexpr std::size_t kHalf = kReach_ns / kGrid_ns;
  static constexpr std::size_t kOffsets = 2 * kHalf + 1;
  static constexpr std::size_t kImages = 16;  // kept: those of kReach_ns and kSpan_ns, and some

  struct Ray {
    std::uint32_t track_id;
    Eigen::Vector3f bearing_cam;
  };
  struct Image {
    std::int64_t stamp_ns = 0;
    double focal_length_px = 0;
    std::vector<Ray> rays;                                // ascending in track id
    bool has_odometry = false;                            // which gives the following
    std::array<Eigen::Quaterniond, kOffsets> q_odom_cam;  // at the stamp plus each offset
    Eigen::Vector3d camera_odom_m;                        // at the stamp plus the centre
  };
  struct Offset {
    double squares = 0;
    Vector6d gradient = Vector6d::Zero();  // by the constant differences: rates, then scales
  };

  Image& image(std::size_t number) { return images_[number % kImages]; }
  void forgetImages();
  void take(const ImageFeatures& features);
  bool findOdometry(Image& image, const OdometryBuffer& odometry) const;
  void compare(std::size_t number);
  static DisplacementGuess wayBetween(const Image& then, const Image& now);
  std::optional<ImageRotation> turnBetween(const Image& then, const Image& now);
  void add(const Image& then, const Image& now, const ImageRotation& turn);
  Vector6d constantsAt(std::size_t offset) const;
  void findMinimum();

  Eigen::Isometry3d T_base_cam_;
  std::int64_t centre_ns_;
  std::array<Image, kImages> images_;
  std::size_t taken_ = 0;      // images so far
  std::size_t used_ = 0;       // of these, oldest first, are done with
  std::int64_t added_ns_ = 0;  // stamp of the image whose turn is the newest in the sums; 0: none
  TrackOrder order_;
  std::vector<BearingPair> pairs_;

  std::array<Offset, kOffsets> offsets_;
  Matrix6d constants_;  // information of the constant differences, the same for all offsets
  Eigen::LDLT<Matrix6d> solver_;            // of it
  double turns_ = 0;                        // so many are in the sums
  double turned_ = 0;                       // squares of the turns themselves
  std::array<double, kOffsets> squares_{};  // with the constant differences fitted away
  std::size_t best_ = kHalf;                // where they are fewest
  TimeOffset estimate_;
};

}  // namespace ardrone_vslam
