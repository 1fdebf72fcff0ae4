// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "ardrone_vslam/features.hpp"
#include "ardrone_vslam/image_view.hpp"
#include "kernels/fast_circle.hpp"

namespace ardrone_vslam {

/// Thins clusters of neighbouring corners (algorithm.md 2; thesis 3.2.2, 3.5, 3.6). Holds the
/// scores of one image's pixels, computed on demand. Allocates only when an image is larger than
/// all before.
class CornerSuppression {
 public:
  /// Forgets all scores and takes a new image, which must outlive the calls below. At least 7x7
  /// pixels.
  void begin(const ImageView& image, int arc_length_px);

  /// From every hit climbs to the 8-neighbour that is highest, until none is higher. Of two pixels
  /// with equal score the one earlier in raster order (row by row from the top left) is the higher
  /// one: a strict order, so that every climb has one end and the ends are exactly the pixels
  /// higher than all their 8 neighbours. So if all corners of an image are hits, the result is the
  /// set of corners that are higher than all their neighbours, and with fewer hits a subset of it.
  /// Neighbours take part with their score even if they were never sampled.
  /// @param hits  corner positions in raster order, at least 3 px from the border; `score` is
  ///   filled in
  /// @param ends  receives the end points in raster order, each once
  void climb(std::vector<Corner>& hits, std::vector<Corner>& ends);

  /// Keeps the hits whose score is greater than that of every hit among their 8 neighbours: of
  /// equal neighbours both are dropped (as cv::FAST does). Pixels that are no hits do not count.
  void keepStrictMaxima(std::vector<Corner>& hits, std::vector<Corner>& kept);

 private:
  /// A place in the image and in the map of scores.
  struct Place {
    const std::uint8_t* pixel;
    std::uint16_t* entry;
    int x_px, y_px;
  };
  void scoreAll(std::vector<Corner>& hits);
  Place placeOf(const Corner& corner);
  Place neighbour(const Place& place, int n) const;
  int scoreAt(const Place& place) const;
  bool reaches(const Place& place, int score) const;
  bool step(Place& place) const;

  ImageView image_;
  kernels::FastCircle circle_{};
  std::vector<std::uint16_t> map_;  ///< for each pixel its score, and whether scored and climbed
};

}  // namespace ardrone_vslam
