// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sequences/sequence.hpp"
#include "simulation/odometry_model.hpp"

namespace ardrone_vslam {

/// What a bag is made of, with stamps in ROS's time.
struct BagContents {
  std::vector<std::int64_t> image_stamps_ns;  ///< by the sequence's images
  std::vector<OdometryState> odometry;
  std::vector<StampedPose> truth;
  std::vector<RangeReading> ranges;
  double scale_error = 0;            ///< drawn by the odometry's profile
  std::int64_t stamp_offset_ns = 0;  ///< added to all stamps, as ROS has no time 0

  /// @pre there is an image
  std::int64_t firstStamp_ns() const;
};

/// @param profile  corrupts the truth to odometry; nothing: the sequence's own odometry
/// @throws std::runtime_error naming the sequence: a profile without truth, stamps outside of ROS's
/// time
BagContents contentsOf(const Sequence& sequence, const std::optional<OdometryProfile>& profile,
                       std::uint64_t seed);

}  // namespace ardrone_vslam
