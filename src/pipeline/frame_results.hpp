// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ardrone_vslam/features.hpp"
#include "ardrone_vslam/frame_result.hpp"
#include "estimator/estimator.hpp"
#include "map/association.hpp"

/// What Slam answers, put together of what its parts say.
namespace ardrone_vslam {

/// Of what is not finite nothing may reach the map.
bool isFinite(const Estimate& estimate);
/// All but stamp, odometry and the counts of noteFeatures() and noteMatches().
FrameResult resultOf(const Estimate& estimate, const Correction& correction,
                     const MapChanges& changes);
/// How many features there are, and how many of them go on between pixels.
void noteFeatures(const ImageFeatures& features, FrameResult& result);
/// How landmarks were looked for, and how many were found.
void noteMatches(const AssociationResult& matches, FrameResult& result);
/// The place is known less well than the estimator says, by this sigma per axis.
void widenPlace(FrameResult& result, double sigma_m);
/// The flight has not been found in its map: the covariance says so to who asks for it alone.
void forgetPlace(FrameResult& result);

}  // namespace ardrone_vslam
