// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "simulation/random_source.hpp"

namespace ardrone_vslam {

/// A grey picture of a wall, painted in metres from its upper left corner, with the random numbers
/// that decide what is painted.
class Painter {
 public:
  static constexpr double kTexelsPerMetre = 250;

  Painter(double width_m, double height_m, std::uint64_t seed, std::uint64_t stream);

  double width_m() const { return width_m_; }
  double height_m() const { return height_m_; }
  RandomSource& random() { return random_; }
  cv::Mat picture() const { return picture_; }

  /// Fills a rectangle [m].
  void fill(const cv::Rect2d& area, double grey);
  /// Fills a convex or concave polygon [m] with smooth edges.
  void polygon(const std::vector<cv::Point2d>& corners, double grey);
  void ellipse(const cv::Point2d& middle, const cv::Size2d& half_axes, double angle_deg,
               double grey);
  void line(const cv::Point2d& from, const cv::Point2d& to, double width_m, double grey);
  /// A line of random capitals and figures of this height, cut off at the area's right border.
  void lettering(const cv::Rect2d& area, double grey);
  /// Adds noise of several octaves: patches of `largest_m` and of each half of that down to one
  /// texel, each octave weaker by `persistence`. `amplitude` is the sigma of the first octave
  /// in grey; `stretch` lengthens the patches along x.
  void noise(const cv::Rect2d& area, double largest_m, double amplitude, double persistence,
             double stretch = 1);

 private:
  cv::Rect texels(const cv::Rect2d& area) const;  // inside the picture; may be empty
  cv::Point fixedPoint(const cv::Point2d& at) const;

  double width_m_;
  double height_m_;
  RandomSource random_;
  cv::Mat picture_;
};

}  // namespace ardrone_vslam
