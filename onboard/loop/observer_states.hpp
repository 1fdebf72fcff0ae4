// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "ardrone_vslam/height_input.hpp"
#include "ardrone_vslam/odometry_adapter.hpp"
#include "ardrone_vslam/odometry_buffer.hpp"
#include "ardrone_vslam/slam_config.hpp"
#include "stamps/stamp_guard.hpp"

namespace ardrone_vslam {

/// The observer's states and heights, kept until images ask for those of their exposure.
class ObserverStates {
 public:
  /// @throws ConfigError
  explicit ObserverStates(const SlamConfig& config);

  /// @return whether it, and those that burst with it, are used
  bool add(const OdometryState& message);
  /// No further state will come.
  void end();
  bool isOver() const { return is_over_; }
  void clear();

  /// @param state  at an image's exposure, with the image's stamp
  OdometryBuffer::Lookup at(std::int64_t exposed_ns, std::int64_t image_ns, OdometryState& state);
  const OdometryBuffer& buffer() const { return buffer_; }

 private:
  bool take(OdometryBuffer::Push answer);

  StampGuard stamps_;
  OdometryAdapter adapter_;
  OdometryBuffer buffer_;
  HeightInput heights_;
  std::vector<OdometryState> ready_;
  bool is_over_ = false;
};

}  // namespace ardrone_vslam
