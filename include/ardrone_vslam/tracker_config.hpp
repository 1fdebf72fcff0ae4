// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "ardrone_vslam/camera_model.hpp"
#include "ardrone_vslam/parameters.hpp"

namespace ardrone_vslam {

/// How a cluster of neighbouring corners becomes one (thesis 3.2.2, 3.5).
/// - kLocalClimb: from every corner found, climb to the 8-neighbour with the highest score until
///   none is higher; each end counts once. Of equal scores the pixel earlier in raster order (row
///   by row from the top left) is the higher. With 16 sampling passes the result is exactly the
///   set of FAST-s corners that are higher, in this order, than all their 8 neighbours: full
///   FAST-s, then the same suppression. With fewer passes it is a subset of that, as neighbours
///   are scored whether they were sampled or not. An end weaker than the threshold of its own cell
///   is dropped.
/// - kStrict3x3: a corner stays if its score is greater than that of every corner among its 8
///   neighbours; of equal neighbours both are dropped, as cv::FAST does. Only tested pixels count:
///   with 16 passes and arc_length_px = 9 the result equals cv::FAST (TYPE_9_16) in place, order
///   and score; with up to 4 passes no two tested pixels are neighbours and nothing is dropped,
///   and with up to 15 what stays need not be the strongest pixel of its cluster.
enum class Suppression { kLocalClimb, kStrict3x3 };

template <>
struct EnumNames<Suppression> {
  static constexpr std::array<const char*, 2> kNames{"climb", "strict"};
};

/// What is a corner, how many of them, and how the threshold follows the image.
struct CornerDetectorConfig {
  int arc_length_px = 12;
  int threshold = 35;
  int sampling_passes = 16;
  Suppression suppression = Suppression::kLocalClimb;
  int features_per_frame = 1000;
  int cell_size_px = 80;
  bool adapt_threshold = true;
  int threshold_min = 8;
  int threshold_max = 120;
};

template <class Visitor>
void visitParameters(CornerDetectorConfig& c, Visitor&& visit) {
  visit(ParameterInfo{"arc_length_px", "px", 9, 12,
                      "contiguous circle pixels that make a corner (FAST-9..12)"},
        c.arc_length_px);
  visit(ParameterInfo{"threshold", "grey", 1, 254,
                      "grey-level difference of a circle pixel; the start value when it adapts"},
        c.threshold);
  visit(ParameterInfo{"sampling_passes", "passes", 1, 16,
                      "pixels tested in each 4x4 block; 16 finds every corner; fewer save time "
                      "without SIMD only"},
        c.sampling_passes);
  visit(ParameterInfo{"suppression", "choice", 0, 0,
                      "climb: to the local maximum, found even when unsampled; strict: 3x3"},
        c.suppression);
  visit(ParameterInfo{"features_per_frame", "corners", 1, 20000,
                      "corner budget, spread over the image cells"},
        c.features_per_frame);
  visit(ParameterInfo{"cell_size_px", "px", 16, 4096,
                      "side of the cells that share the budget and adapt their threshold"},
        c.cell_size_px);
  visit(ParameterInfo{"adapt_threshold", "switch", 0, 0,
                      "let each cell's threshold keep its corner count in a band"},
        c.adapt_threshold);
  visit(
      ParameterInfo{"threshold_min", "grey", 1, 254, "lowest threshold that adaptation may choose"},
      c.threshold_min);
  visit(ParameterInfo{"threshold_max", "grey", 1, 254,
                      "highest threshold that adaptation may choose"},
        c.threshold_max);
}

/// Whether the pattern turns with the patch.
struct FreakConfig {
  bool oriented = true;
};

template <class Visitor>
void visitParameters(FreakConfig& c, Visitor&& visit) {
  visit(ParameterInfo{"oriented", "switch", 0, 0,
                      "turn the pattern by the patch's own orientation (45 pairs); off: upright"},
        c.oriented);
}

/// How far a track may go between two images, and how alike its descriptors must be.
struct FrameTrackerConfig {
  double search_radius_px = 80.0;
  int max_hamming_bits = 100;
  double ratio = 0.85;
};

template <class Visitor>
void visitParameters(FrameTrackerConfig& c, Visitor&& visit) {
  visit(ParameterInfo{"track_search_radius_px", "px", 1.0, 4096.0,
                      "how far a feature may move between two frames"},
        c.search_radius_px);
  visit(ParameterInfo{"track_max_hamming_bits", "bits", 0, 512,
                      "largest descriptor distance within a track"},
        c.max_hamming_bits);
  visit(ParameterInfo{"track_ratio", "-", 0.0, 1.0,
                      "best distance must be below ratio times the second best; 1 is off"},
        c.ratio);
}

/// All that makes features of an image.
struct TrackerConfig {
  CornerDetectorConfig corners;
  FreakConfig freak;
  FrameTrackerConfig tracks;
  UndistortMethod undistort = UndistortMethod::kTable;
  bool use_attitude = false;
};

template <>
struct EnumNames<UndistortMethod> {
  static constexpr std::array<const char*, 3> kNames{"table", "exact", "closed_form"};
};

template <class Visitor>
void visitParameters(TrackerConfig& c, Visitor&& visit) {
  visitParameters(c.corners, visit);
  visitParameters(c.freak, visit);
  visitParameters(c.tracks, visit);
  visit(ParameterInfo{"undistort", "choice", 0, 0,
                      "table: the exact inverse by table, within 1e-6 px; exact: by Newton; "
                      "closed_form: Drap & Lefevre's three terms, pixels off for strong lenses"},
        c.undistort);
  visit(ParameterInfo{"use_attitude", "switch", 0, 0,
                      "turn FREAK's pattern by the odometry's attitude (nodelet: topic `attitude`) "
                      "instead of 45 pairs a corner: cheaper and steadier; without attitude the 45 "
                      "pairs"},
        c.use_attitude);
}

}  // namespace ardrone_vslam
