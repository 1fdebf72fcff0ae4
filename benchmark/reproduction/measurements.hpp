// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>

namespace ardrone_vslam::reproduction {

/// What of the thesis is measured by a program of its own, one function for each section of
/// docs/reproduction.md; reproduce.py writes the page. With the same pictures all but the times is
/// the same each time.
/// @param quick  fewer pictures, frames and repetitions: for tests

/// Tables 3.1-3.5: detectors on pictures of 512x512.
nlohmann::json measureDetectors(bool quick);

/// Figure 3.3: repeatability of FAST-s, s = 9..16, under noise.
nlohmann::json measureRepeatability(bool quick);

/// Table 3.6, figures 3.6-3.8: what FAST costs, against the number of corners.
nlohmann::json measureCornerSpeed(bool quick);

/// Figures 3.11-3.13: corners found and time against the sampling passes.
nlohmann::json measureSampling(bool quick);

/// Tables 4.1 and 4.2: what descriptors cost.
nlohmann::json measureDescriptors(bool quick);

/// Figures 4.5-4.7 and 4.9: what front_end_quality measures, graf aside.
nlohmann::json measureQuality(bool quick);

/// Figure 4.8: matches of two pictures of a wall.
nlohmann::json measureMatches(bool quick);

/// Section 5.2.1: lens correction.
nlohmann::json measureLens(bool quick);

/// Appendix C: the deviation of the weighted mean.
nlohmann::json measureMeanDeviation(bool quick);

/// Appendix D: where a landmark's error lies.
nlohmann::json measureLandmarkDeviation(bool quick);

}  // namespace ardrone_vslam::reproduction
