// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "map_update/map_fix.hpp"

namespace ardrone_vslam {

/// Where the camera is by landmarks that were matched nearly anywhere in the image, most of them
/// wrongly: random sample consensus over pairs, which give a position at the predicted attitude;
/// what agrees with the best ones, within that attitude's sigma, refines position and attitude.
/// The samples are the same in every run. O(observations).
/// @param angle_sigma_rad     sigma_a of a ray
/// @param attitude_sigma_rad  of the predicted attitude relative to the landmarks, per axis
/// @return nothing when so many wrong matches might agree by chance, see agreementsByChance
std::optional<ObservationConsensus> relocate(const Clone& predicted,
                                             const Eigen::Vector3d& camera_rig,
                                             const std::vector<MapObservation>& observations,
                                             double angle_sigma_rad, double attitude_sigma_rad);

/// The same where nothing is known of the position and the heading: a pair of rays gives both, as
/// gravity is known (posesOfPair). @param gravity  any pose of the right roll and pitch
std::optional<ObservationConsensus> relocateAnywhere(
    const Clone& gravity, const Eigen::Vector3d& camera_rig,
    const std::vector<MapObservation>& observations, double angle_sigma_rad, double tilt_sigma_rad);

/// How many poses, of all that three of the matches may give, so many of them are expected to agree
/// with if every match is wrong and agrees with the probability `share`: an upper bound (Chernoff's
/// of the binomial tail).
double agreementsByChance(std::size_t matches, std::size_t agreeing, double share);

/// Whether more than so many poses are expected that so many of the observations agree with if all
/// of them are wrong, given how wide their windows are and how they stand in groups.
/// @param angle_sigma_rad  sigma_a of a ray
bool chanceExplains(const Clone& pose, const Eigen::Vector3d& camera_rig,
                    const std::vector<MapObservation>& observations, std::size_t agreeing,
                    double angle_sigma_rad, double most_by_chance);

}  // namespace ardrone_vslam
