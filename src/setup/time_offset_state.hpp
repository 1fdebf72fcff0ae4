// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <vector>

#include "ardrone_vslam/time_offset.hpp"
#include "odometry/image_rays.hpp"
#include "setup/time_offset_sums.hpp"

namespace ardrone_vslam {

/// What TimeOffsetEstimator does and remembers.
class TimeOffsetEstimator::State {
 public:
  State(const Eigen::Isometry3d& T_base_cam, double centre_s);
  void see(const ImageFeatures& features, const OdometryBuffer& odometry);
  const TimeOffset& estimate() const { return sums_.estimate(); }
  void useCamera(const Eigen::Isometry3d& T_base_cam);

 private:
  static constexpr std::size_t kImages = 16;  // kept: those of kReach_ns and kSpan_ns, and some

  struct Image : ImageRays {
    bool has_odometry = false;  // which gives the following
    AttitudesAtOffsets q_odom_cam;
    Eigen::Vector3d camera_odom_m;  // at the stamp plus the centre
  };
  Image& image(std::size_t number) { return images_[number % kImages]; }
  void forgetImages();
  void take(const ImageFeatures& features);
  bool findOdometry(Image& image, const OdometryBuffer& odometry) const;
  void compare(std::size_t number);
  static DisplacementGuess displacementBetween(const Image& then, const Image& now);
  std::optional<ImageRotation> rotationBetween(const Image& then, const Image& now);

  Eigen::Isometry3d T_base_cam_;
  std::int64_t centre_ns_;
  std::array<Image, kImages> images_;
  std::size_t taken_ = 0;  // images so far
  std::size_t used_ = 0;   // of these, oldest first, are done with
  TrackOrder order_;
  std::vector<BearingPair> pairs_;
  TimeOffsetSums sums_;
};

}  // namespace ardrone_vslam
