// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "ardrone_vslam/parameters.hpp"

namespace ardrone_vslam {

/// What drivers do wrong with odometry, beyond single messages that cannot be used.
enum class OdometryFault {
  kNoCovariance,  ///< messages whose position covariance is all zero
  kJump,          ///< the position jumped by kilometres
  kReset,         ///< the position began anew at the origin
  kRestart,       ///< the stamps began anew
  kWholeMetres,   ///< steps of a height that comes in whole metres
  kBurst,         ///< several messages with one stamp
  kHole,          ///< nothing for so long that the twist no longer tells the way
  kNoTwist,       ///< metres on end that the poses moved with a twist of zeros
  kTurn,          ///< the heading jumped
  kStartedAgain,  ///< at the origin after a gap
  kTableStep,     ///< odometry_mode twist, navdata: another floor below, told from climbing
};
template <>
struct EnumNames<OdometryFault> {
  static constexpr std::array<const char*, 11> kNames{
      "no_covariance", "jump",     "reset", "restart",       "whole_metres", "burst",
      "hole",          "no_twist", "turn",  "started_again", "table_step"};
};
/// Number of the kinds above.
constexpr std::size_t kOdometryFaultCount = EnumNames<OdometryFault>::kNames.size();

/// How often each was seen, by the enumerators' order.
using OdometryFaultCounts = std::array<std::uint64_t, kOdometryFaultCount>;

/// Adds the counts of one source to those of others.
void add(const OdometryFaultCounts& counts, OdometryFaultCounts& sum);

/// Whether users should be told: many sound drivers give no covariance, which is only counted.
bool isWorthWarning(OdometryFault fault);

/// A sentence's end for users, its subject the odometry: what is wrong, what is done, what helps.
const char* explain(OdometryFault fault);

}  // namespace ardrone_vslam
