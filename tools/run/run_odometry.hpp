// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sequences/sequence.hpp"
#include "simulation/odometry_model.hpp"

namespace ardrone_vslam {

/// Odometry to run with, and how it was made.
struct RunOdometry {
  std::string profile;  ///< "recorded" for a real one
  std::optional<std::uint64_t> seed;
  OdometryRun run;
};

/// The sequence's own odometry. @throws std::runtime_error when there is none at the images'
/// stamps, or when it stands still although the truth moves or is unknown
RunOdometry recordedOdometry(const Sequence& sequence);

/// The truth corrupted as a profile says. @throws std::runtime_error without truth, or for an
/// unknown profile
RunOdometry simulatedOdometry(const Sequence& sequence, const std::string& profile,
                              std::uint64_t seed);

/// One for each seed.
/// @param is_at_zero  as of a drone that was switched on at its first pose: there it is at the
/// origin, looking along x. Roll and pitch stay
std::vector<RunOdometry> simulatedOdometries(const Sequence& sequence, const std::string& profile,
                                             const std::vector<std::uint64_t>& seeds,
                                             bool is_at_zero);

/// The truth in the odometry's world: as it is when both start within 0.1 m and 5 degrees of each
/// other, else moved as a whole so that both start at the same pose (a motion-capture system and
/// odometry have different origins).
/// @param moved  set when it was moved
Trajectory truthFromOdometryStart(const Trajectory& truth, const RunOdometry& odometry,
                                  bool& moved);

}  // namespace ardrone_vslam
