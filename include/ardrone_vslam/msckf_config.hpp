// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ardrone_vslam/odometry_config.hpp"
#include "ardrone_vslam/parameters.hpp"

namespace ardrone_vslam {

/// How well heights above the floor are known, and which of them count.
struct HeightConfig {
  double height_sigma_m = 0.03;
  bool floor_points = false;

  // No parameters, but varied by tests.
  double height_interval_s = 0.5;  ///< one height in so much time: a sonar's neighbours err alike
  double floor_step_s = 1;  ///< rejected heights that agree for so long are above another floor
};

template <class Visitor>
void visitParameters(HeightConfig& c, Visitor&& visit) {
  visit(
      ParameterInfo{"floor_points", "switch", 0, 0,
                    "for a camera that looks down: what it sees lies on the floor, as far below as "
                    "the height says (`known_height_m`, `use_range` or `use_navdata_height`). Its "
                    "motion then tells the scale without any climb",
                    turnFirst(7)},
      c.floor_points);
  visit(ParameterInfo{"height_sigma_m", "m", 0.0001, 10,
                      "standard deviation of a height above the floor"},
        c.height_sigma_m);
}

/// How a map of an earlier flight is used.
struct LoadedMapConfig {
  bool localise_only = false;
};

template <class Visitor>
void visitParameters(LoadedMapConfig& c, Visitor&& visit) {
  visit(
      ParameterInfo{
          "localise_only", "switch", 0, 0,
          "a loaded map is never changed, and counts as exact: what it errs by is added to "
          "the pose's covariance. Without a loaded map there are no landmarks then. In flight it "
          "counts when the map begins anew: by `load_map`, `reset`, or stamps that do"},
      c.localise_only);
}

/// What the filter believes of odometry, rays and landmarks, and when it uses them.
struct MsckfConfig : LoadedMapConfig {
  OdometryNoiseConfig odometry;
  double track_sigma_px = 1;
  double track_common_px = 0.7;
  int max_clones = 12;
  int max_anchors = 32;
  double fix_min_age_s = 3;
  /// Landmarks of one place err alike: together they are not taken as better than so many
  /// independent ones. No parameter.
  int fix_independent_landmarks = 10;
  HeightConfig height;

  // No parameter, but varied by tests.
  /// Of a track by itself, beside what its grey levels tell: a scene that is not flat, calibration,
  /// a rolling shutter. Less harms hand-held images, more gives away what alignment gains.
  double track_scene_px = 0.4;
};

template <class Visitor>
void visitParameters(MsckfConfig& c, Visitor&& visit) {
  visitParameters(c.odometry, visit);
  visitParameters(c.height, visit);
  visit(ParameterInfo{"track_common_px", "px", 0, 10000,
                      "error that all tracks of an image share, however many they are: foliage, a "
                      "rolling shutter, calibration. A street needs more than a room",
                      turnFirst(16)},
        c.track_common_px);
  visit(ParameterInfo{"track_sigma_px", "px", 0.01, 100,
                      "standard deviation of a corner: of a landmark's match, and in a track while "
                      "it is not aligned. More with a rolling shutter or blur"},
        c.track_sigma_px);
  visit(ParameterInfo{"max_clones", "frames", 3, 60,
                      "keyframes whose poses are in the state: a long track spans so many. Fewer "
                      "are faster and less exact"},
        c.max_clones);
  visit(ParameterInfo{"max_anchors", "frames", 1, 1000,
                      "earlier keyframes whose error the landmarks made there share; beyond it "
                      "the two nearest of those that follow each other become one. Fewer are "
                      "faster on long flights"},
        c.max_anchors);
  visit(ParameterInfo{"fix_min_age_s", "s", 0, 1e6,
                      "landmarks of an anchor younger than this share the present drift and do not "
                      "correct it"},
        c.fix_min_age_s);
  visitParameters(static_cast<LoadedMapConfig&>(c), visit);
}

}  // namespace ardrone_vslam
