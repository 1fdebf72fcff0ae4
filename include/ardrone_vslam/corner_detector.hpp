// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "ardrone_vslam/features.hpp"
#include "ardrone_vslam/image_view.hpp"
#include "ardrone_vslam/instruction_set.hpp"
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

/// FAST-s corners (thesis 3.1-3.6), thinned by non-maximum suppression and
/// spread over the image.
///
/// A pixel is a corner at threshold t if arc_length_px circle pixels in a row are all brighter
/// than it by more than t, or all darker by more than t (3.1). Its score is the largest such t.
/// The image is divided into a whole number of cells of about cell_size_px, each with a threshold
/// of its own:
/// - each cell gets an equal share of features_per_frame, its strongest corners first, equal ones
///   in raster order; what a cell leaves over goes in equal parts to the cells that have more;
/// - with `adapt_threshold` the cell's threshold follows its number of corners from image to image
///   (once for each detect()), within threshold_min..threshold_max, and keeps that number between
///   one and two shares where the image allows it (up to eight where many cells leave theirs). It
///   starts at `threshold`. So a shaded part of the image is not starved (thesis figure 7.2).
/// Without `adapt_threshold` every cell uses `threshold`. The output depends on nothing but the
/// images since the start or since the image size last changed. Not to be used by two threads at a
/// time.
class CornerDetector {
 public:
  /// Pixels nearer to the border are not tested, as their circle of pixels is not in the image.
  static constexpr int kBorder_px = 3;

  /// @param set  one of supportedInstructionSets(); the corners are the same with each
  /// @throws ConfigError listing every parameter out of its range, threshold_min above
  ///   threshold_max, and a `threshold` outside of threshold_min..threshold_max when it is to
  ///   adapt.
  explicit CornerDetector(const CornerDetectorConfig& config,
                          InstructionSet set = instructionSetInUse().set);
  ~CornerDetector();

  /// Detects the corners of one image.
  /// @param image  at most 32767 px wide and high; a size unlike the last one's starts the
  ///   thresholds afresh. An image that is empty or less than 7 px wide or high has no corners and
  ///   leaves the thresholds as they are.
  /// @param corners  receives at most `features_per_frame` corners in raster order, no two equal,
  ///   each at least 3 px from the border and with a score of at least its cell's threshold
  /// Cost: 0.16 ms with AVX2, 2.1 ms scalar, for 1242x375 px of a street, FAST-12, 16 passes, 1000
  /// corners (one core of a 2-core AMD EPYC virtual machine). Fewer passes: docs/data_path.md.
  /// Allocates for the first image of a size only, and if `corners` has no room for
  /// `features_per_frame` + 1.
  void detect(const ImageView& image, std::vector<Corner>& corners);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ardrone_vslam
