// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <utility>
#include <vector>

#include "support/grey_images.hpp"

// FAST-s and both suppressions by their definitions, with no thought for speed and nothing of the
// code under test.
namespace ardrone_vslam::test {

/// Row and column: their order is raster order.
struct Position {
  int y_px, x_px;
  bool operator<(const Position& o) const {
    return std::make_pair(y_px, x_px) < std::make_pair(o.y_px, o.x_px);
  }
  bool operator==(const Position& o) const { return y_px == o.y_px && x_px == o.x_px; }
};
using Positions = std::set<Position>;

inline bool insideBorder(const GreyImage& image, const Position& p) {
  return p.x_px >= 3 && p.y_px >= 3 && p.x_px < image.width() - 3 && p.y_px < image.height() - 3;
}

inline bool isCornerByDefinition(const GreyImage& image, const Position& p, int arc,
                                 int threshold) {
  // Clockwise from the top: the corner detection literature's drawing of the circle.
  const int dx[16] = {0, 1, 2, 3, 3, 3, 2, 1, 0, -1, -2, -3, -3, -3, -2, -1};
  const int dy[16] = {-3, -3, -2, -1, 0, 1, 2, 3, 3, 3, 2, 1, 0, -1, -2, -3};
  const int centre = image.at(p.x_px, p.y_px);
  for (int start = 0; start < 16; ++start) {
    bool brighter = true;
    bool darker = true;
    for (int n = start; n < start + arc && (brighter || darker); ++n) {
      const int value = image.at(p.x_px + dx[n % 16], p.y_px + dy[n % 16]);
      brighter = brighter && value > centre + threshold;
      darker = darker && value < centre - threshold;
    }
    if (brighter || darker) return true;
  }
  return false;
}

/// The largest threshold at which the pixel is a corner, found by trying them; 0 if there is none.
inline int scoreByDefinition(const GreyImage& image, const Position& p, int arc) {
  for (int threshold = 254; threshold > 0; --threshold) {
    if (isCornerByDefinition(image, p, arc, threshold)) return threshold;
  }
  return 0;
}

/// Scores of all pixels, 0 near the border.
class ScoreOracle {
 public:
  ScoreOracle(const GreyImage& image, int arc) : width_(image.width()), height_(image.height()) {
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        scores_.push_back(insideBorder(image, {y, x}) ? scoreByDefinition(image, {y, x}, arc) : 0);
      }
    }
  }

  int at(const Position& p) const {
    return scores_[static_cast<std::size_t>(p.y_px * width_ + p.x_px)];
  }

  Positions corners(int threshold) const {
    Positions result;
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        if (at({y, x}) >= threshold) result.insert({y, x});
      }
    }
    return result;
  }

  /// Greater score, or equal score and earlier in raster order.
  bool higher(const Position& a, const Position& b) const {
    return at(a) != at(b) ? at(a) > at(b) : a < b;
  }

  Position climb(Position p) const {
    for (;;) {
      Position best = p;
      forNeighbours(p, [&](const Position& q) {
        if (higher(q, best)) best = q;
      });
      if (best == p) return p;
      p = best;
    }
  }

  Positions climb(const Positions& hits) const {
    Positions ends;
    for (const Position& hit : hits) ends.insert(climb(hit));
    return ends;
  }

  /// Those of the hits with a greater score than every other hit beside them.
  Positions strictMaxima(const Positions& hits) const {
    Positions kept;
    for (const Position& hit : hits) {
      bool greatest = true;
      forNeighbours(hit, [&](const Position& q) {
        if (hits.count(q) != 0 && at(q) >= at(hit)) greatest = false;
      });
      if (greatest) kept.insert(hit);
    }
    return kept;
  }

 private:
  template <class Function>
  void forNeighbours(const Position& p, Function&& function) const {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const Position q{p.y_px + dy, p.x_px + dx};
        const bool inside = q.x_px >= 0 && q.y_px >= 0 && q.x_px < width_ && q.y_px < height_;
        if (inside && (dx != 0 || dy != 0)) function(q);
      }
    }
  }

  int width_, height_;
  std::vector<int> scores_;
};

}  // namespace ardrone_vslam::test
