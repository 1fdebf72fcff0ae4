// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "ardrone_vslam/msckf_config.hpp"
#include "ardrone_vslam/odometry_config.hpp"
#include "ardrone_vslam/parameters.hpp"

namespace ardrone_vslam {

/// When the nearest descriptor is taken as a match (thesis 4.1.4). The defaults were measured with
/// about 900 corners an image, FREAK, exact matching and no motion prior, one frame apart: the same
/// point differs in a median of 56 bits (90 % within 131) on KITTI 03 and 40 (93) in the 7-Scenes
/// kitchen; 3.4 % and 4.3 % of the matches are false, against 12 % and 9 % with the cross check
/// alone.
struct MatcherConfig {
  int max_hamming_bits = 90;
  double ratio = 0.85;
  bool cross_check = true;
};

template <class Visitor>
void visitParameters(MatcherConfig& c, Visitor&& visit) {
  visit(ParameterInfo{"max_hamming_bits", "bits", 0, 512, "largest descriptor distance of a match"},
        c.max_hamming_bits);
  visit(ParameterInfo{"match_ratio", "-", 0.0, 1.0,
                      "best distance must be below ratio times the second best; 1 is off"},
        c.ratio);
  visit(ParameterInfo{"match_cross_check", "switch", 0, 0,
                      "a match must be the best one seen from both sides"},
        c.cross_check);
}

/// How landmarks and map features are looked for, and what is a mismatch.
struct AssociationConfig {
  double search_radius_px = 30.0;
  double landmark_threshold_px = 8.0;
  double epipolar_threshold_px = 2.0;
  double threshold_sigmas = 3.0;
  double widening_s = 10.0;
  double max_view_angle_deg = 60.0;
  double max_distance_ratio = 10.0;
  double max_window_share = 0.5;
  int index_from_landmarks = 10000;
  int index_probes = 32;
  MatcherConfig matcher;
};

template <class Visitor>
void visitParameters(AssociationConfig& c, Visitor&& visit) {
  visit(ParameterInfo{"search_radius_px", "px", 1, 2000,
                      "window around the predicted pixel in which descriptors are compared"},
        c.search_radius_px);
  visit(ParameterInfo{"landmark_threshold_px", "px", 0.1, 2000,
                      "a landmark match further from its prediction is a mismatch (5.36)"},
        c.landmark_threshold_px);
  visit(ParameterInfo{"epipolar_threshold_px", "px", 0.1, 2000,
                      "a feature match further from its epipolar line is a mismatch (5.44)"},
        c.epipolar_threshold_px);
  visit(ParameterInfo{"threshold_sigmas", "-", 0, 20,
                      "adds this many deviations of the pose, seen at the landmark's distance, to "
                      "window and threshold; 0: fixed"},
        c.threshold_sigmas);
  visit(ParameterInfo{"widening_s", "s", 0.01, 1e6,
                      "MSCKF: those deviations are taken for twice as large after so "
                      "many seconds in which nothing was recognised, three times after twice as "
                      "many, and so on"},
        c.widening_s);
  visit(ParameterInfo{"max_view_angle_deg", "deg", 1, 180,
                      "landmarks last seen from a direction further off are not searched"},
        c.max_view_angle_deg);
  visit(ParameterInfo{"max_distance_ratio", "-", 1, 1e6,
                      "landmarks are not searched from so many times nearer or further away than "
                      "they were last seen"},
        c.max_distance_ratio);
  visit(ParameterInfo{"max_window_share", "-", 0, 1e6,
                      "when the windows' radius (median) exceeds this share of the image width, "
                      "features are compared with all landmarks, wherever they should be"},
        c.max_window_share);
  visit(ParameterInfo{"index_from_landmarks", "landmarks", 0, 10000000,
                      "maps of so many are then searched by an index, smaller ones exactly"},
        c.index_from_landmarks);
  visit(ParameterInfo{"index_probes", "lists", 1, 1000000,
                      "lists of the index compared with each feature: more find more, slower"},
        c.index_probes);
  visitParameters(c.matcher, visit);
}

/// How landmarks give a position.
enum class MeanKind {
  kPrinted,  ///< the thesis's weighted mean (6.4)
  kExact     ///< weighted least squares over the rays
};

template <>
struct EnumNames<MeanKind> {
  static constexpr std::array<const char*, 2> kNames{"printed", "exact"};
};

/// How landmarks and odometry are weighed, and which fixes are rejected.
struct ThesisFilterConfig {
  MeanKind mean = MeanKind::kPrinted;
  double outlier_sigmas = 3.0;
  bool common_drift = true;
  int min_landmarks = 10;
  double initial_sigma_m = 0.01;
  double odometry_noise_m_per_sqrt_m = 0.015;
  double odometry_noise_m_per_sqrt_s = 0.06;
  double fix_deviation_floor_m = 0.01;
  double fix_angle_floor_deg = 2.0;
  double gate_sigmas = 5.0;
  double attitude_sigma_deg = 0.3;
};

template <class Visitor>
void visitParameters(ThesisFilterConfig& c, Visitor&& visit) {
  visit(
      ParameterInfo{
          "mean", "choice", 0, 0,
          "printed: weighted mean (6.4), damped along the rays; exact: weighted least squares, "
          "undamped, for odometry without drift of scale"},
      c.mean);
  visit(ParameterInfo{"outlier_sigmas", "-", 0, 1e6,
                      "mean exact: a landmark that lies this many robust deviations off its ray "
                      "weighs a quarter, further ones hardly anything; 0: all weigh fully"},
        c.outlier_sigmas);
  visit(ParameterInfo{"common_drift", "switch", 0, 0,
                      "on: landmarks share the drift of the time they were made, so fresh ones "
                      "correct little and old ones all; "
                      "off: independent, as printed"},
        c.common_drift);
  visit(ParameterInfo{"min_landmarks", "landmarks", 1, 1000, "fewer matched landmarks give no fix"},
        c.min_landmarks);
  visit(ParameterInfo{"initial_sigma_m", "m", 1e-6, 100, "position deviation at the first image"},
        c.initial_sigma_m);
  visit(
      ParameterInfo{
          "odometry_noise_m_per_sqrt_m", "m/sqrt(m)", 0, 10,
          "odometry noise per square root of the way, where the odometry gives no covariance"},
      c.odometry_noise_m_per_sqrt_m);
  visit(
      ParameterInfo{
          "odometry_noise_m_per_sqrt_s", "m/sqrt(s)", 0, 10,
          "odometry noise per square root of time, where the odometry gives no covariance"},
      c.odometry_noise_m_per_sqrt_s);
  visit(ParameterInfo{"fix_deviation_floor_m", "m", 0, 10,
                      "errors that all landmarks share: no fix is taken as better than this"},
        c.fix_deviation_floor_m);
  visit(
      ParameterInfo{
          "fix_angle_floor_deg", "deg", 0, 45,
          "the same for errors that grow with the landmarks' distance: attitude and calibration"},
      c.fix_angle_floor_deg);
  visit(ParameterInfo{"gate_sigmas", "-", 0.5, 1e6,
                      "a fix further off the prediction than this many deviations is rejected"},
        c.gate_sigmas);
  visit(ParameterInfo{"attitude_sigma_deg", "deg", 0, 90,
                      "the odometry's attitude, for the published covariance"},
        c.attitude_sigma_deg);
}

/// When a feature becomes a landmark, how well it is known then, and when it is dropped.
struct MapperConfig {
  double angle_sigma_px = 1.0;
  double position_sigma_m = 0.01;
  double min_parallax_deg = 1.0;
  double baseline_growth = 1.2;
  double max_depth_m = 1000.0;
  int drop_unconfirmed_after = 5;
  double drop_failing_ratio = 10;
};

template <class Visitor>
void visitParameters(MapperConfig& c, Visitor&& visit) {
  visit(ParameterInfo{"angle_sigma_px", "px", 0.01, 100,
                      "deviation of a measured direction, sigma_a times the focal length"},
        c.angle_sigma_px);
  visit(ParameterInfo{"position_sigma_m", "m", 0, 10,
                      "smallest sigma_p of a new or refined landmark (5.19, 5.22)"},
        c.position_sigma_m);
  visit(ParameterInfo{"min_parallax_deg", "deg", 0.01, 90,
                      "angle between the first and the present view that makes a landmark"},
        c.min_parallax_deg);
  visit(
      ParameterInfo{
          "baseline_growth", "-", 1.0, 1e6,
          "a young landmark is triangulated again when its parallax has grown by this factor"},
      c.baseline_growth);
  visit(ParameterInfo{"max_depth_m", "m", 0.1, 1e5, "points further away do not become landmarks"},
        c.max_depth_m);
  visit(
      ParameterInfo{
          "drop_unconfirmed_after", "frames", 1, 1000000,
          "a landmark seen at most twice is dropped after so many frames in view without a match"},
      c.drop_unconfirmed_after);
  visit(ParameterInfo{"drop_failing_ratio", "-", 0.1, 1e6,
                      "MSCKF: a landmark is dropped after so many failures for every "
                      "time it was seen: not found while others of its place are, or off an "
                      "accepted fix"},
        c.drop_failing_ratio);
}

/// How many features wait for depth, and how long.
struct FeatureMapConfig {
  int max_map_features = 4000;
  double max_feature_age_s = 10.0;
};

template <class Visitor>
void visitParameters(FeatureMapConfig& c, Visitor&& visit) {
  visit(ParameterInfo{"max_map_features", "features", 1, 1000000,
                      "cap of the map of features without depth; the oldest go"},
        c.max_map_features);
  visit(ParameterInfo{"max_feature_age_s", "s", 0.01, 1e6,
                      "features without a second view are dropped after this time"},
        c.max_feature_age_s);
}

/// How large the map may become.
struct LandmarkMapConfig {
  int max_landmarks = 200000;
};

template <class Visitor>
void visitParameters(LandmarkMapConfig& c, Visitor&& visit) {
  visit(ParameterInfo{"max_landmarks", "landmarks", 10, 10000000,
                      "cap of the map; the ones not seen for longest go first"},
        c.max_landmarks);
}

/// Who makes the pose: docs/data_path.md.
enum class EstimatorKind {
  kThesis,   ///< ThesisFilter
  kMsckf,    ///< Msckf
  kOdometry  ///< nobody: the odometry is passed on
};
template <>
struct EnumNames<EstimatorKind> {
  static constexpr std::array<const char*, 3> kNames{"thesis", "msckf", "odometry"};
};

/// Everything of the mapper / localiser.
struct SlamConfig {
  EstimatorKind estimator = EstimatorKind::kMsckf;
  bool planar = false;
  double image_time_offset_s = 0;
  OdometryBufferConfig odometry;
  OdometryAdapterConfig odometry_adapter;
  DroneFilterConfig drone_filter;
  HeightInputConfig height_input;
  AssociationConfig association;
  ThesisFilterConfig thesis_filter;
  MsckfConfig msckf;
  MapperConfig mapper;
  FeatureMapConfig feature_map;
  LandmarkMapConfig landmark_map;
};

template <class Visitor>
void visitParameters(SlamConfig& c, Visitor&& visit) {
  visit(
      ParameterInfo{
          "estimator", "choice", 0, 0,
          "thesis: weighted mean and scalar fusion; msckf: tracks and landmarks of earlier "
          "visits correct pose and attitude; odometry: passes the odometry on"},
      c.estimator);
  visit(
      ParameterInfo{
          "planar", "switch", 0, 0,
          "2-D mode: all z are zero, for a front camera when height and tilt are unknown"},
      c.planar);
  visit(ParameterInfo{"image_time_offset_s", "s", -5, 5,
                      "an image is exposed at its stamp plus this on the odometry's clock; "
                      "negative where the driver stamps images late (`status` and `replay` tell "
                      "what it seems to be)"},
        c.image_time_offset_s);
  visitParameters(c.odometry, visit);
  visitParameters(c.odometry_adapter, visit);
  visitParameters(c.drone_filter, visit);
  visitParameters(c.height_input, visit);
  visitParameters(c.association, visit);
  visitParameters(c.thesis_filter, visit);
  visitParameters(c.msckf, visit);
  visitParameters(c.mapper, visit);
  visitParameters(c.feature_map, visit);
  visitParameters(c.landmark_map, visit);
}

}  // namespace ardrone_vslam
