// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "ardrone_vslam/height_input.hpp"
#include "ardrone_vslam/odometry_adapter.hpp"
#include "ardrone_vslam/slam_config.hpp"
#include "input_checks/speed_watch.hpp"
#include "sequences/sequence.hpp"

namespace ardrone_vslam {

/// The odometry of a recording, taken as far as the images need it.
class RecordedOdometry {
 public:
  /// @param messages  outlive this
  RecordedOdometry(const SlamConfig& config, const std::vector<OdometryState>& messages);

  /// @param stamp_ns  not before that of the call before
  /// @return whether there is odometry at this stamp
  bool at(std::int64_t stamp_ns, OdometryState& state);

  /// What has been taken so far.
  const OdometryBuffer& buffer() const { return buffer_; }
  const OdometryFaultCounts& faults() const { return adapter_.faults(); }
  /// Not finite, out of bounds, duplicate or backward stamps.
  int refused() const { return refused_; }
  /// SpeedWatch::absurd_m_s
  double absurdSpeed_m_s() const { return speed_.absurd_m_s(); }

 private:
  void takeNext();

  const std::vector<OdometryState>& messages_;
  std::size_t next_ = 0;
  OdometryAdapter adapter_;
  std::vector<OdometryState> ready_;  // kept for its memory
  OdometryBuffer buffer_;
  SpeedWatch speed_;
  int refused_ = 0;
};

/// Its ranges, likewise.
class RecordedHeights {
 public:
  RecordedHeights(const SlamConfig& config, std::vector<RangeReading> readings);

  /// Of base at the image's odometry.
  std::optional<double> at(const OdometryState& state);
  const HeightInput& input() const { return input_; }

 private:
  std::vector<RangeReading> readings_;
  std::size_t next_ = 0;
  HeightInput input_;
};

/// Warns on stderr of heights of navdata that the sequence lacks.
/// @throws std::runtime_error without the ranges that `use_range` asks for
void checkHeights(const Sequence& sequence, const HeightInputConfig& heights);

}  // namespace ardrone_vslam
