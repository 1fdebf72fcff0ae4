// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "ardrone_vslam/features.hpp"
#include "ardrone_vslam/image_view.hpp"
#include "ardrone_vslam/instruction_set.hpp"
#include "ardrone_vslam/tracker_config.hpp"

namespace ardrone_vslam {

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
  /// corners (one core of a 2-core AMD EPYC virtual machine). Fewer passes: docs/front_end.md.
  /// Allocates for the first image of a size only, and if `corners` has no room for
  /// `features_per_frame` + 1.
  void detect(const ImageView& image, std::vector<Corner>& corners);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ardrone_vslam
