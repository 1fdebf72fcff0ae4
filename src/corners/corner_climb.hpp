// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "ardrone_vslam/features.hpp"
#include "ardrone_vslam/image_view.hpp"
#include "corners/corner_cells.hpp"
#include "corners/corner_thresholds.hpp"
#include "kernels/kernels.hpp"

namespace ardrone_vslam {

/// Climbs from corners to the local maxima of the score (thesis 3.2.2, 3.5, 3.6),
/// where not every pixel was tested: holds the scores of one image's pixels, computed on demand.
/// (Where all were, the ends are the maxima that CornerMaxima finds.)
class CornerClimb {
 public:
  explicit CornerClimb(const kernels::Kernels& kernels) : kernels_(kernels) {}

  /// The corners known before, and where climbs begin.
  struct Start {
    const std::vector<Corner>& corners;  ///< in raster order, at least 3 px from the border
    int sampling_passes;                 ///< climbs begin at those that these passes test
    /// If not null, `corners` are all that have at least the threshold of their cell: no other
    /// pixel needs a test to know that.
    const CornerCells* cells;
    const CornerThresholds* thresholds;
  };

  /// From every hit, a corner that was sampled, climbs to the 8-neighbour that is highest, until
  /// none is higher. Of two pixels with equal score the one earlier in raster order (row by row
  /// from the top left) is the higher one: a strict order, so that every climb has one end and the
  /// ends are exactly the pixels higher than all their 8 neighbours. So if all corners of an image
  /// are hits, the result is the set of corners that are higher than all their neighbours, and with
  /// fewer hits a subset of it. Neighbours take part with their score even if they were never
  /// sampled.
  /// @param image  at least 7x7 pixels. Allocates only when its size changes.
  /// @param ends  receives the end points in raster order, each once
  void climb(const ImageView& image, int arc_length_px, const Start& start,
             std::vector<Corner>& ends);

 private:
  /// A place in the image and in the map of scores.
  struct Place {
    const std::uint8_t* pixel;
    std::uint16_t* entry;
    int x_px, y_px;
  };
  void begin(const ImageView& image, int arc_length_px, const Start& start);
  void reset(int width_px, int height_px);
  Place placeOf(const Corner& corner);
  Place neighbour(const Place& place, int n) const;
  int scoreAt(const Place& place);
  bool reaches(const Place& place, int score) const;
  bool step(Place& place);

  const kernels::Kernels kernels_;
  ImageView image_;
  const CornerCells* cells_ = nullptr;
  const CornerThresholds* thresholds_ = nullptr;
  kernels::FastCircle circle_{};
  int map_width_px_ = 0;
  int map_height_px_ = 0;
  std::vector<std::uint16_t> map_;       ///< for each pixel its score, if scored, and if climbed
  std::vector<std::uint16_t*> written_;  ///< entries of the map: to be cleared for the next image
};

}  // namespace ardrone_vslam
