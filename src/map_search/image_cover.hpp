// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "association/associator.hpp"
#include "map/landmark_map.hpp"
#include "matching/frame_view.hpp"

namespace ardrone_vslam {

/// Over how much of an image a map is recognised from a pose: the share of a grid's cells in which
/// some of the landmarks that should be there are. A place that merely has the same furniture, or
/// the same poster on another wall, shows it in a part of the image alone.
class ImageCover {
 public:
  explicit ImageCover(const AssociationConfig& config) : associator_(config) {}

  /// @param view  from the pose; its position's variance widens the windows
  /// @return 0 where no cell should show enough landmarks
  double of(const FrameView& view, LandmarkMap& map);

 private:
  Associator associator_;
  AssociationResult matches_;
};

}  // namespace ardrone_vslam
