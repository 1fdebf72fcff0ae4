// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "ardrone_vslam/features.hpp"
#include "matching/track_order.hpp"
#include "zero_motion/stillness.hpp"

namespace ardrone_vslam {

/// The corners of an image that others are compared with.
class ReferenceImage {
 public:
  /// This one is the reference from now on. O(features log features).
  void take(const ImageFeatures& features);
  /// Number of its corners.
  std::size_t size() const { return corners_.size(); }
  /// Its corners that the image's tracks still hold. O(features log corners).
  std::vector<BearingPair> pairsWith(const ImageFeatures& features) const;
  /// Tracks that have begun anew take the places of lost ones whose corner they show, by place and
  /// descriptor. O(features log features), and the corners near each.
  void findAgain(const ImageFeatures& features, const Eigen::Matrix3d& R_reference_now);

 private:
  struct Corner {
    std::uint32_t track_id;
    Eigen::Vector3d bearing;
    Descriptor descriptor;
  };

  const Corner* find(std::uint32_t track_id) const;
  /// That of the lost ones, ascending in x, that is nearest in its descriptor.
  static std::vector<const Corner*>::iterator sameCorner(const Eigen::Vector3d& bearing,
                                                         const Descriptor& descriptor,
                                                         double reach_rad,
                                                         std::vector<const Corner*>& lost);

  TrackOrder order_;             // of the image's features
  std::vector<Corner> corners_;  // ascending in track id
};

}  // namespace ardrone_vslam
