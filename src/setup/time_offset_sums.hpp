// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>

#include "ardrone_vslam/time_offset.hpp"
#include "odometry/image_rotation.hpp"

namespace ardrone_vslam {

/// Of the offsets that are compared, the one in the middle, which is the centre.
constexpr std::size_t kMiddleOffset =
    TimeOffsetEstimator::kReach_ns / TimeOffsetEstimator::kGrid_ns;
constexpr std::size_t kOffsetCount = 2 * kMiddleOffset + 1;
/// The camera in odom at an image's stamp plus each offset.
using AttitudesAtOffsets = std::array<Eigen::Quaterniond, kOffsetCount>;

/// The turn between two images, by their tracks and by the odometry.
struct ComparedRotation {
  std::int64_t stamp_ns;  ///< of the later image
  double span_s;
  const AttitudesAtOffsets& then;
  const AttitudesAtOffsets& now;
  const ImageRotation& by_tracks;
  double displacement_sigma_m;  ///< sigma of the camera's way between them
};

/// The squares of the differences between the two turns, for each offset, and where they are
/// fewest.
class TimeOffsetSums {
 public:
  /// @param centre_ns  the offset that the others lie about
  explicit TimeOffsetSums(std::int64_t centre_ns);

  void add(const ComparedRotation& rotation);
  /// The next turn is of other images: no time has passed before it.
  void breakOff() { added_ns_ = 0; }
  const TimeOffset& estimate() const { return estimate_; }

 private:
  struct Offset {
    double squares = 0;
    Vector6d gradient = Vector6d::Zero();  // by the constant differences: rates, then scales
  };

  Vector6d constantsAt(std::size_t offset) const;
  void findMinimum();

  std::int64_t centre_ns_;
  std::array<Offset, kOffsetCount> offsets_;
  Matrix6d constants_;  // information of the constant differences, the same for all offsets
  Eigen::LDLT<Matrix6d> solver_;                // of it
  std::int64_t added_ns_ = 0;                   // stamp of the newest image in the sums; 0: none
  double rotations_ = 0;                        // so many are in the sums
  double rotation_squares_ = 0;                 // of the rotations themselves
  std::array<double, kOffsetCount> squares_{};  // with the constant differences fitted away
  std::size_t best_ = kMiddleOffset;            // where they are fewest
  TimeOffset estimate_;
};

}  // namespace ardrone_vslam
