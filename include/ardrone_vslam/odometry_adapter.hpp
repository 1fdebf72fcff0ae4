// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "ardrone_vslam/odometry_buffer.hpp"
#include "ardrone_vslam/odometry_config.hpp"
#include "ardrone_vslam/odometry_faults.hpp"

namespace ardrone_vslam {

/// Odometry messages -> the states that OdometryBuffer is given. Recognises what drivers do wrong,
/// repairs what it can and counts it. Deterministic: the stamps are its only clock.
class OdometryAdapter {
 public:
  /// @throws ConfigError listing every parameter out of its range
  explicit OdometryAdapter(const OdometryAdapterConfig& config);
  ~OdometryAdapter();

  /// One message, as it came: its position may be out of bounds. From the first burst of equal
  /// stamps on, messages are held until the next stamp comes, to be spread over the gap before.
  /// @param ready  gets the states that are ready, stamps ascending; none, one or a burst
  /// @return why this message, or one held before it, is not used; else kAccepted
  OdometryBuffer::Push push(const OdometryState& message, std::vector<OdometryState>& ready);

  /// What is held, when no further message will come.
  OdometryBuffer::Push flush(std::vector<OdometryState>& ready);

  /// What was wrong with the messages so far, by cause.
  const OdometryFaultCounts& faults() const;

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace ardrone_vslam
