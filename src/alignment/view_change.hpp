// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace ardrone_vslam {

/// How a view turned about its axis and grew: a similarity of the image plane without its shift.
struct ViewChange {
  float along = 1;   ///< growth times the turn's cosine
  float across = 0;  ///< growth times its sine, from columns to rows

  /// Where an offset in the first image lies in the second.
  Eigen::Vector2f operator*(const Eigen::Vector2f& offset_px) const;
  /// First `before`, then this.
  ViewChange operator*(const ViewChange& before) const;
  /// From the second image to the first.
  ViewChange inverse() const;
  /// How much larger the second image shows things.
  float growth() const;
  /// How far a pixel is moved otherwise than by `other`, as a share of its distance from the
  /// middle.
  float differenceFrom(const ViewChange& other) const;
};

/// Where a track was in one image, and where it is in the next.
struct TrackMove {
  Eigen::Vector2f before_px = Eigen::Vector2f::Zero();
  Eigen::Vector2f now_px = Eigen::Vector2f::Zero();
};

/// What most tracks have in common, by least squares with weights (Geman and McClure 1985): wrong
/// matches and what moves by itself hardly count.
/// @return no change where fewer than 8 tracks tell it, and where it is none that goes on between
///   two images (differenceFrom() of half)
ViewChange commonViewChange(const std::vector<TrackMove>& moves);

}  // namespace ardrone_vslam
