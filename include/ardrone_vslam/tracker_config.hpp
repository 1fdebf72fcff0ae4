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

/// What is a corner, how many of them, and how the threshold follows the image.
struct CornerDetectorConfig {
  int features_per_frame = 1000;
  int cell_size_px = 80;
  int threshold_min = 8;

  // No parameters: what the thesis's experiments, benchmarks and tests vary. The defaults were the
  // best or the cheapest there.
  int arc_length_px = 12;    ///< contiguous circle pixels that make a corner: 9 to 12
  int threshold = 35;        ///< grey-level difference of a circle pixel; the start when it adapts
  int threshold_max = 120;   ///< highest that adaptation chooses
  int sampling_passes = 16;  ///< pixels tested in each 4x4 block, 1 to 16: 16 finds every corner
  Suppression suppression = Suppression::kLocalClimb;  ///< of neighbouring corners
  bool adapt_threshold = true;  ///< each cell's threshold keeps its corner count in a band
};

template <class Visitor>
void visitParameters(CornerDetectorConfig& c, Visitor&& visit) {
  visit(ParameterInfo{"features_per_frame", "corners", 1, 20000,
                      "most corners taken of one image, spread over its cells. More: better "
                      "matches, slower",
                      turnFirst(18)},
        c.features_per_frame);
  visit(ParameterInfo{"cell_size_px", "px", 16, 4096,
                      "side of the cells that share the corners and adapt their threshold; smaller "
                      "where a part of the image is dark"},
        c.cell_size_px);
  visit(ParameterInfo{"threshold_min", "grey", 1, 35,
                      "lowest grey-level difference of a corner that a dark cell may go down to"},
        c.threshold_min);
}

/// Whether the pattern turns with the patch. No parameter: upright patterns lose what turns.
struct FreakConfig {
  bool oriented = true;  ///< false: upright
};

/// How far a track may go between two images, and how alike its descriptors must be.
struct FrameTrackerConfig {
  double search_radius_px = 80.0;

  // No parameters, but varied by tests.
  int max_hamming_bits = 100;  ///< largest descriptor distance within a track
  double ratio = 0.85;         ///< the best distance must be below this share of the second best
};

template <class Visitor>
void visitParameters(FrameTrackerConfig& c, Visitor&& visit) {
  visit(ParameterInfo{"track_search_radius_px", "px", 1.0, 4096.0,
                      "how far a feature may move between two images; more for fast turns and few "
                      "images a second",
                      turnFirst(17)},
        c.search_radius_px);
}

/// All that makes features of an image.
struct TrackerConfig {
  CornerDetectorConfig corners;
  FreakConfig freak;  ///< has no parameters
  FrameTrackerConfig tracks;
  bool use_attitude = false;
  bool align_tracks = true;  ///< no parameter. False: on whole pixels, as the thesis has them
  UndistortMethod undistort = UndistortMethod::kTable;  ///< no parameter: docs/lens_correction.md
};

template <class Visitor>
void visitParameters(TrackerConfig& c, Visitor&& visit) {
  visitParameters(c.corners, visit);
  visitParameters(c.tracks, visit);
  visit(ParameterInfo{"use_attitude", "switch", 0, 0,
                      "turn descriptors by the odometry's attitude (the nodelet's topic "
                      "`attitude`) and not by each corner's own look: cheaper and steadier"},
        c.use_attitude);
}

}  // namespace ardrone_vslam
