// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <string>

#include "ardrone_vslam/delayed_fusion.hpp"

namespace ardrone_vslam {

/// The mapper's corrections, which wait for the odometry at their stamps.
class CorrectionQueue {
 public:
  /// Of a correction that is not used: why.
  using Refuse = std::function<void(const std::string& fault)>;

  /// @param odometry_topic  for users
  CorrectionQueue(DelayedFusion& fusion, std::string odometry_topic, Refuse refuse);

  void add(const LateCorrection& correction);
  /// Uses those whose odometry has come. @return whether there was one
  bool use();
  void clear() { waiting_.clear(); }

  std::uint64_t used() const { return used_; }
  /// Refused as the odometry of their time was no longer kept.
  std::uint64_t tooOld() const { return too_old_; }

 private:
  /// Why it was not used, and what helps.
  std::string explain(DelayedFusion::Answer answer, const LateCorrection& correction) const;

  DelayedFusion& fusion_;
  std::string odometry_topic_;
  Refuse refuse_;
  std::deque<LateCorrection> waiting_;  // stamps ascend
  std::uint64_t used_ = 0;
  std::uint64_t too_old_ = 0;
};

}  // namespace ardrone_vslam
