// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>

#include "ardrone_vslam/msckf_config.hpp"
#include "ardrone_vslam/odometry_config.hpp"
#include "ardrone_vslam/parameters.hpp"

namespace ardrone_vslam {

/// When the nearest descriptor is taken as a match (thesis 4.1.4). The defaults were measured with
/// about 900 corners an image, FREAK, exact matching and no motion prior, one frame apart: the same
/// point differs in a median of 56 bits (90 % within 131) on KITTI 03 and 40 (93) in the 7-Scenes
/// kitchen; 3.4 % and 4.3 % of the matches are false, against 12 % and 9 % with the cross check
/// alone. No
/// parameters: the values hold for the descriptor, not for a robot.
struct MatcherConfig {
  int max_hamming_bits = 90;  ///< largest distance of a match
  double ratio = 0.85;        ///< best distance over the second best must be below; 1: any
  bool cross_check = true;    ///< a match must be the best one seen from both sides
};

/// How landmarks and map features are looked for, and what is a mismatch.
struct AssociationConfig {
  double landmark_threshold_px = 8.0;
  double threshold_sigmas = 3.0;
  double epipolar_threshold_px = 2.0;

  // No parameters, but varied by tests. The pose's own sigma widens what follows.
  double search_radius_px = 30.0;  ///< window around the predicted pixel
  /// Landmarks last seen from a direction further off look different, so they are not searched.
  double max_view_angle_deg = 60.0;
  double max_distance_ratio = 10.0;  ///< likewise from so many times nearer or further away
  /// When the windows' radius (median) exceeds this share of the image's width, features are
  /// compared with all landmarks, wherever they should be.
  double max_window_share = 0.5;
  int index_from_landmarks = 10000;  ///< such maps are then searched by an index
  int index_probes = 32;             ///< of its lists: more find more, slower
  MatcherConfig matcher;             ///< which descriptors match
};

template <class Visitor>
void visitParameters(AssociationConfig& c, Visitor&& visit) {
  visit(ParameterInfo{"landmark_threshold_px", "px", 0.1, 2000,
                      "a landmark match further from its prediction is a mismatch (thesis 5.36)"},
        c.landmark_threshold_px);
  visit(ParameterInfo{"threshold_sigmas", "-", 0, 20,
                      "adds so many standard deviations of the pose, as seen at the landmark's "
                      "distance, to `landmark_threshold_px` and to the search window; 0: fixed, "
                      "which loses the map when the pose drifts"},
        c.threshold_sigmas);
  visit(ParameterInfo{"epipolar_threshold_px", "px", 0.1, 2000,
                      "a feature match further from its epipolar line is a mismatch (5.44)",
                      ofPart(PagePart::kThesis)},
        c.epipolar_threshold_px);
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

/// How landmarks alone give a position.
struct LocatorConfig {
  int min_landmarks = 10;

  // No parameters, but varied by tests and by the reproduction of the thesis.
  /// kExact is undamped along the rays: for odometry without drift of scale.
  MeanKind mean = MeanKind::kPrinted;
  /// With kExact: a landmark that lies so many robust sigmas off its ray weighs a quarter,
  /// further ones hardly anything; 0: all weigh fully.
  double outlier_sigmas = 3.0;
  double fix_sigma_floor_m = 0.01;  ///< errors that all landmarks share: no fix is better
  /// The same for errors that grow with the landmarks' distance: attitude and calibration.
  double fix_angle_floor_deg = 2.0;
};

template <class Visitor>
void visitParameters(LocatorConfig& c, Visitor&& visit) {
  visit(ParameterInfo{"min_landmarks", "landmarks", 1, 1000, "fewer matched landmarks give no fix",
                      ofPart(PagePart::kThesis)},
        c.min_landmarks);
}

/// How landmarks and odometry are weighed, and which fixes are rejected.
struct ThesisFilterConfig : LocatorConfig {
  bool as_printed = false;
  double odometry_noise_m_per_sqrt_m = 0.015;
  double odometry_noise_m_per_sqrt_s = 0.06;

  // No parameters, but varied by tests and by the reproduction of the thesis.
  /// Landmarks share the drift of the time they were made, so fresh ones correct little; false:
  /// independent, as printed.
  bool common_drift = true;
  double initial_sigma_m = 0.01;  ///< of the position at the first image
  double gate_sigmas = 5.0;       ///< a fix further off the prediction is rejected
};

/// The thesis's localisation without the package's own corrections: landmarks are independent, a
/// fix may be as good as it claims, and none is rejected.
inline ThesisFilterConfig asPrinted(ThesisFilterConfig config) {
  constexpr double kNoGate = 1e6;
  config.common_drift = false;
  config.fix_sigma_floor_m = 0;
  config.fix_angle_floor_deg = 0;
  config.gate_sigmas = kNoGate;
  return config;
}

template <class Visitor>
void visitParameters(ThesisFilterConfig& c, Visitor&& visit) {
  visit(ParameterInfo{"as_printed", "switch", 0, 0,
                      "the localisation as the thesis prints it: landmarks are independent, a fix "
                      "is taken as good as it claims, none is rejected",
                      ofPart(PagePart::kThesis)},
        c.as_printed);
  visitParameters(static_cast<LocatorConfig&>(c), visit);
  visit(ParameterInfo{"odometry_noise_m_per_sqrt_m", "m/sqrt(m)", 0, 10,
                      "noise of the odometry's position per square root of distance, where the "
                      "odometry gives no covariance",
                      ofPart(PagePart::kThesis)},
        c.odometry_noise_m_per_sqrt_m);
  visit(ParameterInfo{"odometry_noise_m_per_sqrt_s", "m/sqrt(s)", 0, 10,
                      "noise of the odometry's position per square root of time, where the "
                      "odometry gives no covariance",
                      ofPart(PagePart::kThesis)},
        c.odometry_noise_m_per_sqrt_s);
}

/// When a feature becomes a landmark, how well it is known then, and when it is dropped.
struct MapperConfig {
  // No parameters, but varied by tests.
  double max_depth_m = 200;        ///< points further away do not become landmarks
  double angle_sigma_px = 1.0;     ///< of a measured direction: sigma_a times the focal length
  double position_sigma_m = 0.01;  ///< smallest sigma_p of a landmark (5.19, 5.22)
  double min_parallax_deg = 1.0;   ///< between first and present view: less tells no depth
  double baseline_growth = 1.2;    ///< a young landmark is triangulated again at so much parallax
  int drop_unconfirmed_after = 5;  ///< images in view without a match, when seen at most twice
  /// So many failures for every time it was seen and two more: not found while others of its place
  /// are, or off an accepted fix.
  double drop_failing_ratio = 2;
};

/// How many features wait for depth, and how long. No parameters: a camera that moves gives a
/// feature its depth within seconds.
struct FeatureMapConfig {
  int max_map_features = 4000;      ///< the oldest go first
  double max_feature_age_s = 10.0;  ///< without a second view
};

/// What a landmark takes at most, indices and room to grow included (LandmarkMapIndex tests it).
constexpr int kLandmark_bytes = 400;

/// How large the map may become.
struct LandmarkMapConfig {
  int max_landmarks = 200000;
  int max_map_mb = 0;

  /// Landmarks, by both.
  int most() const {
    const int by_memory = max_map_mb * (1'000'000 / kLandmark_bytes);
    return max_map_mb > 0 && by_memory < max_landmarks ? by_memory : max_landmarks;
  }
};

template <class Visitor>
void visitParameters(LandmarkMapConfig& c, Visitor&& visit) {
  visit(ParameterInfo{"max_landmarks", "landmarks", 10, 10000000,
                      "cap of the map; those go first that are worth least: seldom or long ago "
                      "matched, badly known, one of many in their place",
                      turnFirst(19)},
        c.max_landmarks);
  visit(ParameterInfo{"max_map_mb", "MB", 0, 10000,
                      "cap of the memory that landmarks take: 2500 of them each; 0: "
                      "`max_landmarks` alone"},
        c.max_map_mb);
}

/// How long an image may take.
struct FrameBudgetConfig {
  double frame_budget_ms = 0;
};

template <class Visitor>
void visitParameters(FrameBudgetConfig& c, Visitor&& visit) {
  visit(
      ParameterInfo{
          "frame_budget_ms", "ms", 0, 10000,
          "longest time for an image: in the mapper from its features on, in vslam_onboard "
          "processor time from the tracker on. What does not fit is left out in this "
          "order: search for the place, landmarks, keyframe; `status` tells. 0: no bound"},
      c.frame_budget_ms);
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
  NumberOrAuto image_time_offset_s;
  FrameBudgetConfig frame_budget;
  OdometryBufferConfig odometry;
  OdometryAdapterConfig odometry_adapter;
  HeightInputConfig height_input;
  AssociationConfig association;
  ThesisFilterConfig thesis_filter;
  MsckfConfig msckf;
  MapperConfig mapper;           ///< has no parameters
  FeatureMapConfig feature_map;  ///< has no parameters
  LandmarkMapConfig landmark_map;
};

/// Why a configuration can neither load nor save maps; empty when it can.
/// @param landmarks  of a map that is to be loaded: all of it is
std::string faultOfMaps(const SlamConfig& config, std::size_t landmarks = 0);

/// Of `image_time_offset_s`, also the tracker's.
constexpr const char* kImageTimeOffset =
    "an image is exposed at its stamp plus this on the odometry's clock: negative where the driver "
    "stamps images late. With auto it is 0, until the mapper has found it by the turns of camera "
    "and odometry; `status` and `replay` tell what it is. In the tracker for `use_attitude`, where "
    "auto is 0";

template <class Visitor>
void visitParameters(SlamConfig& c, Visitor&& visit) {
  visit(
      ParameterInfo{
          "estimator", "choice", 0, 0,
          "msckf: tracks, and landmarks of earlier visits, correct pose and attitude. thesis: the "
          "thesis's weighted mean and scalar fusion. odometry: the odometry is passed on",
          turnFirst(1)},
      c.estimator);
  visit(ParameterInfo{"image_time_offset_s", "s", -5, 5, kImageTimeOffset, turnFirst(2)},
        c.image_time_offset_s);
  visit(
      ParameterInfo{
          "planar", "switch", 0, 0,
          "base moves in a plane: a robot on a level floor. Its z is held; with estimator "
          "thesis all z are zero, for a front camera when height and tilt are unknown",
          turnFirst(6)},
      c.planar);
  visitParameters(c.frame_budget, visit);
  visitParameters(c.odometry, visit);
  visitParameters(c.odometry_adapter, visit);
  visitParameters(c.height_input, visit);
  visitParameters(c.association, visit);
  visitParameters(c.thesis_filter, visit);
  visitParameters(c.msckf, visit);
  visitParameters(c.landmark_map, visit);
}

}  // namespace ardrone_vslam
