// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ardrone_vslam/odometry_config.hpp"
#include "ardrone_vslam/parameters.hpp"

namespace ardrone_vslam {

/// When an image counts as still, and what it may hide.
struct ZeroMotionConfig {
  double rest_after_s = 1;
  double rest_sigma_px = 0.8;
  double rest_turn_deg_per_s = 3;
  double rest_depth_m = 10;
};

template <class Visitor>
void visitParameters(ZeroMotionConfig& c, Visitor&& visit) {
  visit(ParameterInfo{"rest_after_s", "s", 0.05, 1e6,
                      "MSCKF: the image must be still for so long, its turning taken "
                      "out, before the camera counts as resting and its position is held"},
        c.rest_after_s);
  visit(ParameterInfo{"rest_sigma_px", "px", 0.05, 100,
                      "MSCKF: how far a corner at rest jumps between two images, per "
                      "axis"},
        c.rest_sigma_px);
  visit(ParameterInfo{"rest_turn_deg_per_s", "deg/s", 0.1, 1000,
                      "MSCKF: a still camera that turns faster is rotating"},
        c.rest_turn_deg_per_s);
  visit(ParameterInfo{"rest_depth_m", "m", 0.1, 1e6,
                      "MSCKF: how far away the scene is taken to be while no landmark "
                      "says it; further away an image that is still, or hardly moves, hides more "
                      "motion. Outdoors: the distance to what is seen"},
        c.rest_depth_m);
}

/// How much contradiction ends the trust in the camera, and for how long.
struct WatchdogConfig {
  double watchdog_sigmas = 15;
  double watchdog_nis = 8;
  double watchdog_s = 3;
  double watchdog_pause_s = 10;
};

template <class Visitor>
void visitParameters(WatchdogConfig& c, Visitor&& visit) {
  visit(ParameterInfo{"watchdog_sigmas", "-", 1, 1e6,
                      "MSCKF: trust in the camera ends when it says for watchdog_s that "
                      "the odometry's velocity is wrong by so many velocity_bias_m_s, and no place "
                      "seen before confirms it"},
        c.watchdog_sigmas);
  visit(ParameterInfo{"watchdog_nis", "-", 1, 10,
                      "or when the fixes of watchdog_s were further off than they claim (fix_nis)"},
        c.watchdog_nis);
  visit(ParameterInfo{"watchdog_s", "s", 0.1, 1e6, "MSCKF: so long it must last"}, c.watchdog_s);
  visit(ParameterInfo{"watchdog_pause_s", "s", 0, 1e6,
                      "MSCKF: then the pose is the odometry's for so long; each time it happens "
                      "again, twice as long"},
        c.watchdog_pause_s);
}

/// How well heights above the floor are known, and which of them count.
struct HeightConfig {
  double height_sigma_m = 0.03;
  double height_interval_s = 0.5;
  double height_gate_sigmas = 3;
  double floor_step_s = 1;
  bool floor_points = false;
  double floor_point_sigma_m = 0.1;
};

template <class Visitor>
void visitParameters(HeightConfig& c, Visitor&& visit) {
  visit(ParameterInfo{"height_sigma_m", "m", 0.0001, 10,
                      "MSCKF: deviation of a height above the floor"},
        c.height_sigma_m);
  visit(ParameterInfo{"height_interval_s", "s", 0, 1000,
                      "MSCKF: one height in so much time is used, as neighbours err "
                      "alike"},
        c.height_interval_s);
  visit(ParameterInfo{"height_gate_sigmas", "-", 0.5, 1e6,
                      "MSCKF: a height that disagrees by more than this is rejected"},
        c.height_gate_sigmas);
  visit(ParameterInfo{"floor_step_s", "s", 0, 1000,
                      "MSCKF: rejected heights that agree with each other for so long "
                      "are above another floor (a table)"},
        c.floor_step_s);
  visit(ParameterInfo{"floor_points", "switch", 0, 0,
                      "MSCKF: what a camera that looks down sees lies on the floor, as "
                      "far below as the height says (known_height_m, use_range or "
                      "use_navdata_height): its way tells the scale without any climb"},
        c.floor_points);
  visit(ParameterInfo{"floor_point_sigma_m", "m", 0.0001, 10,
                      "MSCKF: deviation of such a point from the floor, the height's "
                      "own error included"},
        c.floor_point_sigma_m);
}

/// What the filter believes of odometry, rays and landmarks, and when it uses them.
struct MsckfConfig {
  OdometryNoiseConfig odometry;
  bool attitude_states = true;
  double track_sigma_px = 1;
  double track_common_px = 0.7;
  int window_frames = 12;
  double keyframe_px = 15;
  double keyframe_s = 2;
  int min_track_views = 3;
  double track_parallax_sigmas = 6;
  double baseline_uncertainty = 0.5;
  double landmark_sigma = 0.2;
  double anchor_spacing = 0.3;
  double anchor_turn_deg = 20;
  int max_anchors = 32;
  int min_fix_landmarks = 6;
  int fix_independent_landmarks = 10;
  double fix_min_age_s = 3;
  double fix_drift_share = 1;
  double fix_gate_sigmas = 2;
  double relocation_window_deg = 15;
  double relocation_gate_sigmas = 5;
  ZeroMotionConfig rest;
  WatchdogConfig watchdog;
  HeightConfig height;
};

template <class Visitor>
void visitParameters(MsckfConfig& c, Visitor&& visit) {
  visitParameters(c.odometry, visit);
  visit(ParameterInfo{"attitude_states", "switch", 0, 0,
                      "MSCKF: estimate attitude errors; false: the cheaper linear form, "
                      "which takes the odometry's attitude and the mounting as exact"},
        c.attitude_states);
  visit(ParameterInfo{"track_sigma_px", "px", 0.01, 100, "MSCKF: deviation of a track's rays"},
        c.track_sigma_px);
  visit(ParameterInfo{"track_common_px", "px", 0, 10000,
                      "what a keyframe's tracks err alike: together they are not taken as better"},
        c.track_common_px);
  visit(ParameterInfo{"window_frames", "frames", 3, 60,
                      "MSCKF: frames of the window; a long track spans so many"},
        c.window_frames);
  visit(
      ParameterInfo{"keyframe_px", "px", 0, 10000,
                    "the window keeps a frame when the image has moved so far since the last one, "
                    "its turning taken out, or when half of the tracks are lost"},
      c.keyframe_px);
  visit(ParameterInfo{"keyframe_s", "s", 0.001, 1e6, "or when so much time has passed"},
        c.keyframe_s);
  visit(ParameterInfo{"min_track_views", "frames", 2, 60,
                      "tracks with fewer views in the window are not used"},
        c.min_track_views);
  visit(ParameterInfo{"track_parallax_sigmas", "-", 0, 1000,
                      "nor those with less parallax than this many deviations of a ray"},
        c.track_parallax_sigmas);
  visit(ParameterInfo{"baseline_uncertainty", "-", 0.001, 1000,
                      "nor those whose baseline is less well known across than this share of it"},
        c.baseline_uncertainty);
  visit(ParameterInfo{"landmark_sigma", "-", 0.001, 1000,
                      "MSCKF: a track becomes a landmark when its point is known to "
                      "this share of its distance"},
        c.landmark_sigma);
  visit(
      ParameterInfo{"anchor_spacing", "-", 0.01, 100,
                    "landmarks share the error of the frame they belong to; a new one begins after "
                    "this share of the landmarks' distance"},
      c.anchor_spacing);
  visit(ParameterInfo{"anchor_turn_deg", "deg", 0.1, 180, "or after this turn"}, c.anchor_turn_deg);
  visit(ParameterInfo{"max_anchors", "frames", 1, 1000,
                      "so many such frames are told apart; the nearest ones become one beyond"},
        c.max_anchors);
  visit(ParameterInfo{"min_fix_landmarks", "landmarks", 4, 100000,
                      "fewer landmarks of earlier visits that agree give no fix"},
        c.min_fix_landmarks);
  visit(ParameterInfo{"fix_independent_landmarks", "landmarks", 1, 1000000,
                      "a fix is not taken as better than so many independent landmarks make it"},
        c.fix_independent_landmarks);
  visit(ParameterInfo{"fix_min_age_s", "s", 0, 1e6,
                      "younger landmarks share the present drift and give no fix"},
        c.fix_min_age_s);
  visit(
      ParameterInfo{"fix_drift_share", "-", 0, 1e6,
                    "a fix waits until the drift's variance is so many times its own, so that the "
                    "same landmarks do not count again and again"},
      c.fix_drift_share);
  visit(
      ParameterInfo{"fix_gate_sigmas", "-", 0.5, 1e6,
                    "a fix that disagrees by more than this in the mean of its six coordinates is "
                    "rejected"},
      c.fix_gate_sigmas);
  visit(ParameterInfo{"relocation_window_deg", "deg", 0.1, 180,
                      "of landmarks that were looked for further around their prediction a few may "
                      "fix the pose, "
                      "too, when more agree than chance can explain; else it takes most of all "
                      "that were found"},
        c.relocation_window_deg);
  visit(ParameterInfo{"relocation_gate_sigmas", "-", 0.5, 1e6,
                      "fix_gate_sigmas of such a fix: after a blind stretch the odometry has "
                      "often drifted more than it claims"},
        c.relocation_gate_sigmas);
  visitParameters(c.rest, visit);
  visitParameters(c.watchdog, visit);
  visitParameters(c.height, visit);
}

}  // namespace ardrone_vslam
